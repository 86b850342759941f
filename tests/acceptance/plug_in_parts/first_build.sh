# What tests/acceptance/plug_in promises of the first build; to be sourced by it.
# Seconds are those of both cores at work, added up: another program on the same
# machine changes them little.
before=8bff3af # with which it is compared

# cpu COMMAND...: the seconds of user and system that it takes. Fails if the
# command does, with the end of what it printed.
cpu() {
  local TIMEFORMAT='%U %S' code=0
  { time "$@" >"$work/build.log" 2>&1; } 2>"$work/build.time" || code=$?
  if [[ $code != 0 ]]; then
    say "$* ends with $code:"
    tail -n 20 "$work/build.log" >&2
    return 1
  fi
  tail -n 1 "$work/build.time" | awk '{ printf "%.0f", $1 + $2 }'
}

# unbuilt WHAT: a row that fails; no other of this part can be measured.
unbuilt() { line "first build: $1" "failed" "is built" false; }

# checked_out COMMIT FOLDER: as a user has it, without a build.
checked_out() {
  git -C "$root" archive --prefix="$2/" "$1" | tar -x -C "$work"
}

# alone NAME COMMAND...: with caches of its own in $work/NAME.
alone() {
  env XDG_CACHE_HOME="$work/$1" CCACHE_DIR="$work/$1/ccache" \
    SOFOF_PACKAGES=skip SOFOF_CAF_TARBALL="$work/caf.tar.gz" "${@:2}"
}

# thousands FOLDER: lines of ours that the default targets compile.
thousands() {
  (cd "$work/$1" && find . -name '*.[hc]pp' -not -path './tests/*' \
    -not -path './examples/*' -not -path './build/*' -print0 \
    | xargs -0 cat | wc -l | awk '{ print $1 / 1000 }')
}

# share A B: A in per cent of B.
share() { awk "BEGIN { printf \"%.0f\", 100 * $1 / $2 }"; }

# compiled NAME: of ccache's statistics, "missed of all".
compiled() {
  alone "$1" ccache --print-stats | awk '
    /^cache_miss/ { missed = $2 }
    /^(direct|preprocessed)_cache_hit/ { hits += $2 }
    END { print missed + 0, missed + hits }'
}

first_build() {
  [[ ! $short ]] || return 0
  local name caf ours missed all
  local -A caf_s=() ours_s=()
  cp "$(bash "$root/cmake/caf/fetch.sh" "$work/downloads")" "$work/caf.tar.gz"
  if ! git -C "$root" cat-file -e "$before^{commit}" 2>/dev/null; then
    say "$before is not in this repository: compared with what is known of it"
    caf_s[old]=200 ours_s[old]=294
  fi
  checked_out HEAD new
  checked_out HEAD second
  if [[ ! ${caf_s[old]:-} ]]; then checked_out "$before" old; fi
  for name in new old; do
    [[ -d $work/$name ]] || continue
    say "CAF, then sofof of $name, with empty caches"
    caf_s[$name]=$(cpu alone "$name" "$work/$name/cmake/caf/build.sh") \
      || { unbuilt "CAF of $name"; return 0; }
    ours_s[$name]=$(cpu alone "$name" "$work/$name/sofof" setup) \
      || { unbuilt "sofof of $name"; return 0; }
  done
  caf=$(share "${caf_s[new]}" "${caf_s[old]}")
  at_most "CAF: ${caf_s[new]} s of ${caf_s[old]} s" "$caf" % 60
  ours=$(share "$((ours_s[new] + caf_s[new]))" "$((ours_s[old] + caf_s[old]))")
  at_most "first build: $((ours_s[new] + caf_s[new])) s" "$ours" % 100
  counted "lines that the default targets compile" "$(thousands new) thousand"
  if [[ -d $work/old ]]; then
    ours=$(awk "BEGIN { print ${ours_s[new]} / $(thousands new) }")
    all=$(awk "BEGIN { print ${ours_s[old]} / $(thousands old) }")
    at_most "ours per thousand lines: $ours s of $all s" \
      "$(share "$ours" "$all")" % 60
  fi
  say "a second checkout, with the first one's caches"
  alone new ccache --zero-stats >/dev/null
  ours=$(cpu alone new "$work/second/sofof" setup) \
    || { unbuilt "a second checkout"; return 0; }
  counted "a second checkout" "$ours s"
  read -r missed all < <(compiled new)
  at_most "second checkout: $missed of $all compiled" \
    "$(share "$missed" "$all")" % 10
}
