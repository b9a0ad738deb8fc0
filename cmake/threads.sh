# Sourced by ./check --long: the program under the thread sanitizer.
source cmake/debian_source.sh

# oneTBB with the thread sanitizer, in build/tbb. Through Debian's own, of which the sanitizer sees nothing, every task handed
# over is a false alarm. The source is Debian's (cmake/debian_source.sh).
build_tbb() {
  local tbb=$PWD/build/tbb
  [ ! -e "$tbb/installed" ] || return 0
  debian_source onetbb "$tbb" &&
    cmake -S "$tbb/source" -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_STRICT=OFF -DTBB_TEST=OFF \
      -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON --log-level=WARNING &&
    cmake --build "$tbb/build" && cmake --install "$tbb/build" --prefix "$tbb/installed" >/dev/null
}

# Runs what takes several threads, each work and its way of sharing once; the first race ends it, with both places.
look_at_threads() {
  local gonio=build/threads/gonio out=build/threads/looked spec=lambert+ggx/smith_ggx.correlated/schlick seed
  local -x TSAN_OPTIONS="halt_on_error=1 exitcode=66"
  rm -rf "$out" && mkdir -p "$out/tables"
  for seed in 1 2 3; do
    "$gonio" synth "$spec" --set alpha=0.15 f0=0.05 kd=0.2,0.1,0.05 --layout hemisphere --noise 0.02 --seed "$seed" -o "$out/tables/$seed.csv"
  done
  "$gonio" fit "$out/tables/1.csv" --model "$spec" -o "$out/fit.json" --html "$out/fit.html" >"$out/said"
  "$gonio" fit "$out/tables" --model "$spec" -o "$out/results" >>"$out/said"
  "$gonio" albedo ggx/smith_ggx.correlated/conductor --set alpha=0.8 metal=Au --mu 0.5 --scattering walk --seed 7 >>"$out/said"
  "$gonio" stability ndf.ggx --domain alpha=0.05,1 --require relative=0.02 >>"$out/said"
  "$gonio" audit --all >>"$out/said"
  "$gonio" report schlick -o "$out/reports" >>"$out/said"
}
