# What tests/acceptance/plug_in promises of schemas; to be sourced by it.

schema() {
  local tests=$root/build/release/tests/test_experiments kind sum
  tested "schemas: every file in config" \
    "The schemas accept every file in config" "accepted"
  for kind in scenarios maps sweeps; do
    tested "schemas: $kind with a mistake" \
      "The schema of $kind refuses what the program refuses" "refused"
  done
  tested "schemas: sweeps with a mistake in their scenario's options" \
    "The schema of sweeps knows the options of scenarios" "refused"
  sum=$(grep -c '^    {"' "$root/tests/experiments/schema_mistakes.hpp")
  line "files with a mistake" "$sum" ">= 60" holds "60 <= $sum"
  bash "$root/.ci/install" /usr/lib/python3/dist-packages/jsonschema \
    python3-jsonschema >&2 || true
  if $python -c 'import jsonschema' 2>/dev/null; then
    sum=$($python "$here/other_validator.py" "$program" "$root/config")
    line "config, by python3-jsonschema" "$sum" "all accepted" all_of "$sum"
  else
    counted "config, by python3-jsonschema" "not installed"
  fi
}
