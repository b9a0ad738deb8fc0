# Sourced by ./check --long: the program under the thread sanitizer.

# oneTBB with the thread sanitizer, in build/tbb. Through Debian's own, of which the sanitizer sees nothing, every task handed
# over is a false alarm. The source is Debian's, found by a list of our own: nothing outside build/ is touched.
build_tbb() {
  local tbb=$PWD/build/tbb apt
  [ ! -e "$tbb/installed" ] || return 0
  command -v apt-get >/dev/null && [ "$(. /etc/os-release && echo "$ID")" = debian ] || return 1
  mkdir -p "$tbb/lists/partial" "$tbb/source"
  echo "deb-src http://deb.debian.org/debian $(. /etc/os-release && echo "$VERSION_CODENAME") main" >"$tbb/sources.list"
  apt=(apt-get -qq -o Dir::Etc::sourcelist="$tbb/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$tbb/lists"
    -o Dir::Cache="$tbb" -o APT::Sandbox::User=)
  "${apt[@]}" update && (cd "$tbb" && "${apt[@]}" source --download-only onetbb) &&
    tar -xf "$tbb"/onetbb_*.orig.tar.* -C "$tbb/source" --strip-components=1 &&
    cmake -S "$tbb/source" -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_STRICT=OFF -DTBB_TEST=OFF \
      -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON --log-level=WARNING &&
    cmake --build "$tbb/build" && cmake --install "$tbb/build" --prefix "$tbb/installed" >/dev/null
}
