# What tests/acceptance/plug_in promises of python/sofof; to be sourced by it.
figures="$python -B $here/python_figures.py"
export PYTHONPATH=$root/python

# told NAME: a figure that python_figures printed into $work/figures.
told() { awk -F '\t' -v n="$1" '$1 == n { print $2 }' "$work/figures"; }

# asked WORDS...: what python_figures measures, into $work/figures.
asked() {
  SOFOF=$program $figures "$@" >"$work/figures" 2>"$work/why" || {
    cat "$work/why" >&2
    failed=$((failed + 1))
  }
}

environments() {
  local lasts=600 name
  [[ ! $short ]] || lasts=200
  for name in mixed_fleet corridor_3sp; do
    say "environments of $name, $lasts s"
    asked speed "$root/config/bench/$name.toml" "$lasts"
    for kind in OffloadingEnv env; do
      line "$name, $kind: steps a CPU second" "$(told "$kind")" ">= 1000" \
        holds "1000 <= $(told "$kind")"
    done
    counted "$name, parallel_env: agent's steps a CPU second" \
      "$(told parallel_env)"
  done
  asked together "$root/config/bench/mixed_fleet.toml" "$lasts"
  line "four at once: rewards as one after another" "$(told same)" \
    "4 of 4" all_of "$(told same)"
  line "same seed and actions: same rewards" "$(told again)" "4 of 4" \
    all_of "$(told again)"
  line "other seeds: other rewards" "$(told other)" "3 of 3" \
    all_of "$(told other)"
  asked left "$root/config/bench/mixed_fleet.toml"
  zero "after close, exception, kill: processes" "$(told processes)"
  zero "likewise: descriptors, sockets with a name" "$(told files)"
  local checkers
  checkers=$(told checkers)
  counted "checkers of Gymnasium and PettingZoo" "${checkers:-unknown}"
  tests_of environments "conformance after their documents, ours"
}

# tests_of FILE PROMISE: python/tests/test_FILE.py.
tests_of() {
  local said
  said=$(SOFOF=$program "$python" -B "$root/python/tests/test_$1.py" 2>&1) \
    && code=0 || code=$?
  line "$2" "$(sed -n 's/^Ran \([0-9]* tests\).*/\1/p' <<<"$said")" "pass" \
    [ "$code" = 0 ]
}

tables() {
  tests_of results "each table of docs/results.md with its types"
  tests_of plots "pictures, compared with references"
  tests_of policy "the ten lines of the README, and the protocol"
}

agent() {
  local table=$work/q.txt seeds=20
  [[ ! $short ]] || seeds=5
  say "training a table in mixed_fleet"
  asked train "$table"
  by_clock at_most "agent: trained in" "$(told seconds)" s 300
  counted "agent: episodes, decisions" "$(told episodes)"
  say "ranking it on $seeds seeds that it was not trained on"
  asked rank "$table" "$work/board" "$seeds"
  local who
  for who in random always; do
    line "mixed_fleet: score of the agent, of $who" \
      "$(told "table"), $(told "$who")" "intervals apart" \
      holds "$(told table_high) < $(told "${who}_low")"
  done
  counted "mixed_fleet: score of location" "$(told location)"
  line "its runs" "$(told unsafe) unsafe" "0" holds "$(told unsafe) == 0"
}
