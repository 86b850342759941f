# What tests/acceptance/plug_in promises of services that are programs; to be
# sourced by it.

# told_by PART ARGUMENT...: the rows of a part of programs.py, which measures.
told_by() {
  local label measured limit result
  while IFS=$'\t' read -r label measured limit result; do
    if [[ $result == counted ]]; then counted "$label" "$measured"
    else line "$label" "$measured" "$limit" [ "$result" == pass ]; fi
  done < <("$python" -B "$here/programs.py" "$1" "$program" "$root" "$work" \
    "${short:-long}" || printf 'programs.py %s\tbroke off\tit ends\tfail\n' "$1")
}

detection() { told_by detection; }
program_deaths() { told_by deaths; }
program_hogs() { told_by hogs; }
