# What tests/acceptance/plug_in promises of vehicles that serve others; to be
# sourced by it.

# convoy_run NAME WORDS...: config/convoy.toml into $work/NAME.
convoy_run() {
  "$program" run "$root/config/convoy.toml" --quiet --force \
    --out "$work/$1" "${@:2}" >/dev/null
}
convoy_figures() { "$here/convoy_figures" "$@"; }

convoy() {
  local lasts=600s dies=300
  [[ ! $short ]] || { lasts=120s; dies=60; }
  say "a leader and five followers, $lasts, twice"
  convoy_run led --set duration=$lasts
  convoy_run again --set duration=$lasts
  local share own
  share=$(convoy_figures offloaded "$work/led" 101)
  line "convoy: offloaded, of five followers the least" "$share %" ">= 80 %" \
    holds "80 <= $share"
  own=$(convoy_figures served "$work/led" 101)
  zero "convoy: offloadings of the leader itself" "$own"
  zero "convoy: collisions" "$(field "$work/led" safety.collisions)"
  zero "convoy: s without a fresh plan" \
    "$(field "$work/led" safety.without_fresh_plan_s)"
  local file same=0 all=0
  for file in episodes.csv cycles.csv tracks.csv responses.csv events.jsonl; do
    all=$((all + 1))
    ! cmp -s "$work/led/$file" "$work/again/$file" || same=$((same + 1))
  done
  line "convoy: the same file and seed, twice" "$same of $all files" \
    "same bytes" all_of "$same of $all files"

  say "its computer dies after $dies s"
  convoy_run lost --set duration=$((dies + 20))s \
    --set fleet.0.fails_at=${dies}s || true # the leader is without a plan
  at_most "convoy: leader gone, to the first own control value" \
    "$(convoy_figures home "$work/lost" 101 $dies)" ms 120
  zero "convoy: leader gone, collisions" \
    "$(field "$work/lost" safety.collisions)"
  zero "convoy: leader gone, followers' s without a fresh plan" \
    "$(convoy_figures planless "$work/lost" 101)"
}
