#!/bin/sh
# Puts SwiftShader, the software Vulkan driver of Chromium, into a folder: swiftshader.sh FOLDER
set -eu

folder=$1
driver=libvk_swiftshader.so
description=vk_swiftshader_icd.json

take() {
	mkdir -p "$folder"
	cp "$1/$driver" "$1/$description" "$folder"
	echo "swiftshader: from $1"
}

if [ -f "$folder/$driver" ] && [ -f "$folder/$description" ]; then
	exit 0
fi
for place in /usr/lib/chromium /usr/lib/chromium-browser /opt/google/chrome; do
	if [ -f "$place/$driver" ] && [ -f "$place/$description" ]; then
		take "$place"
		exit 0
	fi
done
if ! command -v apt-get >/dev/null || ! command -v dpkg-deb >/dev/null; then
	echo "swiftshader: install Chromium and try again, or put $driver and $description into $folder" >&2
	exit 1
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Nothing is installed: the driver needs two files of the package and no other package.
fetch() { (cd "$work" && apt-get download -qq "$1") >/dev/null 2>&1; }
as_root=""
[ "$(id -u)" = 0 ] || as_root="sudo"
fetch chromium-common || { $as_root apt-get update -qq && fetch chromium-common; } || fetch chromium || {
	echo "swiftshader: apt-get has neither chromium-common nor chromium" >&2
	exit 1
}
for package in "$work"/*.deb; do
	dpkg-deb -x "$package" "$work"
done
found=$(find "$work" -name "$driver" | head -n 1)
if [ -z "$found" ]; then
	echo "swiftshader: no $driver in $(basename "$work"/*.deb)" >&2
	exit 1
fi
take "$(dirname "$found")" >/dev/null
echo "swiftshader: from the package $(basename "$work"/*.deb)"
