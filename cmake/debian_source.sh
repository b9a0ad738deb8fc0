# Sourced by cmake/threads.sh and cmake/wheel.sh: sources of Debian's packages.

# debian_source PACKAGE FOLDER: the upstream source of this release's package, in FOLDER/source.  The package is found by a list of our
# own, and its digests are checked by apt against the release's signature: nothing outside FOLDER is touched.
debian_source() {
  local package=$1 at=$2 apt
  [ ! -e "$at/source" ] || return 0
  command -v apt-get >/dev/null && [ "$(. /etc/os-release && echo "$ID")" = debian ] || return 1
  mkdir -p "$at/lists/partial" "$at/unpacked"
  echo "deb-src http://deb.debian.org/debian $(. /etc/os-release && echo "$VERSION_CODENAME") main" >"$at/sources.list"
  apt=(apt-get -qq -o Dir::Etc::sourcelist="$at/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$at/lists"
    -o Dir::Cache="$at" -o APT::Sandbox::User=)
  "${apt[@]}" update && (cd "$at" && "${apt[@]}" source --download-only "$package") &&
    tar -xf "$at/$package"_*.orig.tar.* -C "$at/unpacked" --strip-components=1 && mv "$at/unpacked" "$at/source"
}
