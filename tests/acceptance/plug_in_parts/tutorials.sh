# What tests/acceptance/plug_in promises of tutorials and of the gallery; to be
# sourced by it.

# a_clone: what is committed, in $work/clone, set up as its reader does.
a_clone() {
  git clone -q "$root" "$work/clone"
  SOFOF_PACKAGES=skip "$work/clone/sofof" setup >"$work/clone.log" 2>&1 || {
    tail -n 20 "$work/clone.log" >&2
    return 1
  }
}

tutorials() {
  local page said missing options=(--sofof "$program")
  bash "$root/.ci/install" netgenerate sumo >&2 || true
  bash "$root/.ci/install" sbatch slurm-wlm munge >&2 || true
  bash "$root/.ci/install" /usr/lib/python3/dist-packages/matplotlib \
    python3-matplotlib python3-pandas >&2 || true
  missing=$(slurm_lacks)
  if [[ ! $missing ]]; then begin_slurm; else say "no Slurm:$missing"; fi
  if [[ ! $short ]]; then
    say "a clean clone, set up"
    if ! a_clone; then
      line "a clean clone is set up" "failed" "ready" false
      return 0
    fi
    options=(--clone "$work/clone")
  fi
  for page in "$root"/docs/tutorials/*.md; do
    [[ $page != */README.md ]] || continue
    code=0
    said=$($python -B "$root/tests/tutorials/run" "${options[@]}" \
      --shared-network "$page" 2>&1) || code=$?
    if [[ $said == *SKIPPED* ]]; then
      grep SKIPPED <<<"$said" >&2
      counted "tutorial: ${page##*/}" "$(grep -c SKIPPED <<<"$said") left out"
      [[ $code != 1 ]] || line "tutorial: ${page##*/}, the rest" no yes false
      continue
    fi
    line "tutorial: ${page##*/}" "${said#*: }" "as the page says" [ $code = 0 ]
    [[ $code = 0 ]] || printf '%s\n' "$said" >&2
  done
}

gallery() {
  local said code=0 words=(docs/pictures/make --check --sofof "$program")
  bash "$root/.ci/install" chromium >&2 || true
  bash "$root/.ci/install" /usr/lib/python3/dist-packages/PIL python3-pil \
    >&2 || true
  said=$(cd "$root" && $python -B "${words[@]}" 2>&1) || code=$?
  line "gallery: scenarios that run and are drawn the same" \
    "$(grep -c '\.svg: .*, equal$' <<<"$said") of 10" "all, byte by byte" \
    [ "$(grep -c '\.svg: .*, equal$' <<<"$said")" = 10 ]
  if [[ $said == *SKIPPED* ]]; then
    counted "pictures of the report" "no Chromium or PIL: not made"
  else
    line "pictures of the report, made anew" \
      "$(grep -cE '\.(png|webp): .*, equal$' <<<"$said") of 2" \
      "<= 6 of 255 off" [ $code = 0 ]
  fi
  [[ $code = 0 ]] || printf '%s\n' "$said" >&2
}
