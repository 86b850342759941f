# What tests/acceptance/plug_in promises of policies as processes and of
# snapshots; to be sourced by it.
mirror="$python $here/mirror.py"

# process COMMAND [MORE]: the argument that has it decide in vehicles.
process() { printf 'policies.lodm={name="process",command="%s"%s}' "$1" "${2:-}"; }

# ran NAME ARGUMENT...: a run of SOFOF in $work; sets `code`. What it says is in
# $work/NAME.err.
ran() {
  code=0
  (cd "$work" && "$program" "${@:2}" --quiet --out "$work/$1" \
    >"$work/$1.log" 2>"$work/$1.err") || code=$?
}

policies() {
  local bench=$root/config/bench name
  say "a program that mirrors nearest, in two scenarios"
  for name in corridor_3sp mixed_fleet; do
    ran "nearest_$name" run "$bench/$name.toml" --set policies.lodm=nearest
    ran "mirror_$name" run "$bench/$name.toml" --set "$(process "$mirror")"
    line "$name: cycles.csv of the mirror and of nearest" \
      "$(stat -c %s "$work/mirror_$name/cycles.csv") bytes" "the same bytes" \
      cmp -s "$work/mirror_$name/cycles.csv" "$work/nearest_$name/cycles.csv"
    line "$name: events.jsonl likewise" \
      "$(stat -c %s "$work/mirror_$name/events.jsonl") bytes" "the same bytes" \
      cmp -s "$work/mirror_$name/events.jsonl" "$work/nearest_$name/events.jsonl"
  done
  ran again run "$work/mirror_corridor_3sp/config.toml"
  line "its results run again" "exit code $code" "the same bytes" \
    cmp -s "$work/again/cycles.csv" "$work/nearest_corridor_3sp/cycles.csv"
  counted "decisions in corridor_3sp" \
    "$(timing mirror_corridor_3sp lodm_decisions)"
  timed by_clock at_most "a decision, mean" \
    "$(timing mirror_corridor_3sp lodm_decide_mean_us)" us 250
  cached
}

# timing FOLDER NAME: of its timing.csv.
timing() { awk -F, -v n="$2" '$1 == n { print $2 }' "$work/$1/timing.csv"; }

# What a sweep makes anew when the program changes.
cached() {
  cp "$here/mirror.py" "$work/mine.py"
  cp "$root/config/bench/single_intersection.toml" "$work/"
  sed -i "s|^map = .*|map = \"$(map_of single_intersection)\"|" \
    "$work/single_intersection.toml"
  cat >"$work/sweep.toml" <<END
name = "mine"
scenario = "single_intersection.toml"
seeds = 2
[set]
duration = "20s"
"policies.lodm" = { name = "process", command = "$python mine.py" }
END
  local first second third fourth
  ran sweep sweep sweep.toml
  first=$(runs_kept)
  ran sweep sweep sweep.toml
  second=$(runs_kept)
  echo "# changed" >>"$work/mine.py"
  ran sweep sweep sweep.toml
  third=$(runs_kept)
  line "runs of a sweep, of the same again" "$first, $second" "2, 2" \
    [ "$first, $second" = "2, 2" ]
  line "the program is changed: runs" "$third" 4 [ "$third" = 4 ]
  sed -i 's/, "version": "1"//' "$work/mine.py"
  ran sweep sweep sweep.toml
  ran sweep sweep sweep.toml
  fourth=$(runs_kept)
  line "without a version: runs, twice the same" "$fourth" 8 [ "$fourth" = 8 ]
  ran sweep sweep sweep.toml --shard 1/2
  line "and shared out to shards: exit code" "$code" "2, a sentence" \
    grep -q "tells no version" "$work/sweep.err"
}
# map_of NAME: the map of a scenario of the bench, as an absolute path.
map_of() {
  local map
  map=$(sed -n 's/^map = "\(.*\)"/\1/p' "$root/config/bench/$1.toml")
  realpath "$root/config/bench/$map"
}
runs_kept() { find "$work/sweep/runs" -maxdepth 1 -mindepth 1 ! -name '.*' | wc -l; }

policy_faults() {
  local scenario=$root/config/bench/corridor_3sp.toml kind
  declare -A says=(
    [killed]="was ended by signal 9" [ended]="exited with 3"
    [silent]="did not answer in time" [slow]="did not answer in time"
    [babbling]="more than 65536 octets" [twice]="more than one line"
    [wrong]="answered ask 20 wrongly" [closed]="closed its output")
  for kind in killed ended silent slow babbling twice wrong closed; do
    ran "$kind" run "$scenario" --duration 60s --set \
      "$(process "$python $here/faulty.py $kind 20" ',time_limit="1s"')"
    line "$kind: exit code, results, what is said" \
      "$code, $([[ -e $work/$kind ]] && echo some || echo none)" \
      "1, none, a sentence" \
      says_only "$kind" "${says[$kind]}"
  done
  local count=1000
  [[ ! $short ]] || count=100
  say "$count mutated answers"
  local told
  told=$("$python" "$here/mutations.py" "$program" "$scenario" "$work" "$count") \
    || true
  line "mutated answers: exit 1, a sentence, no results" \
    "$told" "all, or still right" all_of "${told%%;*}"
  zero "programs that are left, zombies" \
    "$(pgrep -fc "$here/(faulty|mutations).py" || true)"
}
# says_only NAME TEXT: whether it failed with one line that says that, and left
# nothing.
says_only() {
  [[ $code == 1 && ! -e $work/$1 ]] && (($(wc -l <"$work/$1.err") == 1)) \
    && grep -q "$2" "$work/$1.err"
}

snapshots() {
  local scenario=$root/config/bench/single_intersection.toml name
  tests=$root/build/release/tests/test_policies
  tested "decisions from a file and in memory, all learners" \
    "what each learner has learned decides from a file as it does in memory, and otherwise than before" same
  tested "another policy, shape, no snapshot" \
    "a file of another policy, another shape, or that is no snapshot is refused with its line, and nothing changes" refused
  for name in q_learning dqn ucb1 alto; do
    say "$name learns"
    (cd "$work" && "$program" train "$scenario" --policy "$name" --seeds 2 \
      --quiet --set duration=120s --out "$work/$name.txt" >"$work/$name.log")
    (cd "$work" && "$program" train "$scenario" --policy "$name" --seeds 2 \
      --quiet --set duration=120s --out "$work/again.txt" >"$work/$name.log")
    line "$name: trained twice" "$(wc -l <"$work/$name.txt") lines" \
      "the same bytes" cmp -s "$work/$name.txt" "$work/again.txt"
    ran "by_$name" run "$scenario" --duration 60s --set \
      "policies.lodm={name=\"$name\",snapshot=\"$work/$name.txt\"}"
    ran "rerun_$name" run "$work/by_$name/config.toml"
    line "$name: a run by it, and its results again" "exit code $code" \
      "the same bytes" \
      cmp -s "$work/by_$name/events.jsonl" "$work/rerun_$name/events.jsonl"
    sed 's/version 1/version 2/' "$work/$name.txt" >"$work/other.txt"
    ran refused run "$scenario" --set \
      "policies.lodm={name=\"$name\",snapshot=\"$work/other.txt\"}"
    line "$name: of another shape" "exit code $code" "2, file, line, why" \
      grep -q "other.txt, line 3: it has the shape .*; train one" \
      "$work/refused.err"
  done
}
