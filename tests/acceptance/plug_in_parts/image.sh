# What tests/acceptance/plug_in promises of the image of a container; to be
# sourced by it.

# buildah with storage of its own: no daemon, nothing left behind.
in_store() {
  buildah --storage-driver vfs --root "$work/store" --runroot "$work/runroot" \
    "$@"
}

# image_built: the image "sofof", on a Debian 12 made here.
image_built() {
  local base context=$work/context
  mmdebstrap --variant=minbase bookworm "$work/debian.tar" 2>"$work/image.log" \
    || return 1
  base=$(in_store from scratch)
  in_store add -q "$base" "$work/debian.tar" / >/dev/null
  in_store commit -q "$base" localhost/debian:12 >/dev/null
  in_store rm "$base" >/dev/null
  cp -r "$root/packaging/container" "$context"
  cp "$package" "$context/sofof.deb"
  in_store bud --isolation chroot --format docker \
    --build-arg BASE=localhost/debian:12 -t sofof "$context" \
    >>"$work/image.log" 2>&1
}

# of_image EXPRESSION: of what the image says of itself, `c`.
of_image() {
  in_store inspect --type image localhost/sofof | $python -c "
import json, sys
c = json.load(sys.stdin)['Docker']['config']
print($1)"
}

image() {
  [[ ! $short ]] || return 0
  local package='' said files container
  for said in buildah mmdebstrap "dpkg-shlibdeps dpkg-dev"; do
    # shellcheck disable=SC2086 # a command and its package
    bash "$root/.ci/install" $said >&2 || true
  done
  package_built || { line "image: package built" no yes false; return 0; }
  if ! image_built; then
    tail -n 5 "$work/image.log" >&2
    say "no image could be built (is there a network?): not measured"
    counted "image" "not measured"
    return 0
  fi
  container=$(in_store from localhost/sofof)
  files=$(in_store mount "$container")
  said=$(du -sb "$files" | awk '{ printf "%.1f", $1 / 1e6 }')
  at_most "image: size" "$said" MB 30
  line "image: user" "$(of_image "c['User']")" "not root" \
    [ "$(of_image "c['User']")" = 10001:10001 ]
  said=$(of_image "' '.join(c['Healthcheck']['Test'][1:3])")
  line "image: health check" "$said" "sofof health" \
    [ "$said" = "/usr/bin/sofof health" ]
  said=$(find "$files" -perm /6000 -o -name sh -o -name bash | wc -l)
  zero "image: shells, and programs with rights of others" "$said"
  said=$(chroot --userspec=10001:10001 "$files" /usr/bin/sofof run \
    /usr/share/sofof/config/ulm_lehr.toml --quiet --out /var/lib/sofof/run 2>&1 \
    && echo done || true)
  line "image: its program, in its file system, as its user" "${said##*$'\n'}" \
    "main job done" [ "${said##*$'\n'}" = done ]
  in_store umount "$container" >/dev/null
  in_store rm "$container" >/dev/null
}
