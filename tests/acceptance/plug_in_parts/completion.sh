# What tests/acceptance/plug_in promises of completion and the manual; to be
# sourced by it.

completion() {
  local said
  bash "$root/.ci/install" zsh >&2 || true
  bash "$root/.ci/install" man man-db >&2 || true
  said=$($python -B "$root/tests/completion/test_completion.py" "$program" 2>&1 \
    || true)
  line "words completed in bash and zsh on a terminal; manual" \
    "$(awk '/^Ran/ { print $2, "tests" }' <<<"$said")" "all pass" \
    grep -q '^OK$' <<<"$said"
  counted "keys of --set that are offered" \
    "$("$program" completion bash | awk '/^_sofof_keys=/ { on = 1; next }
      on && /^.$/ { exit } on { n += NF } END { print n }')"
}
