#!/bin/sh
# Sees to it that there is a Vulkan driver. Metal and DX12 come with their systems.
set -eu

if [ "$(uname -s)" != Linux ]; then
	echo "setup: nothing to install on $(uname -s)"
	exit 0
fi

has_loader() { ldconfig -p 2>/dev/null | grep -q 'libvulkan\.so\.1'; }
has_driver() {
	[ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] ||
		ls /usr/share/vulkan/icd.d/*.json /usr/local/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json \
			/usr/local/nvidia/share/vulkan/icd.d/*.json 2>/dev/null | grep -q .
}

if has_loader && has_driver; then
	echo "setup: a Vulkan driver is installed"
	exit 0
fi
if ! command -v apt-get >/dev/null; then
	echo "setup: no Vulkan driver found. Install one (Mesa's lavapipe will do) and try again." >&2
	exit 1
fi
as_root=""
[ "$(id -u)" = 0 ] || as_root="sudo"
echo "setup: no Vulkan driver found; installing Mesa's software driver (mesa-vulkan-drivers, libvulkan1)"
$as_root apt-get update -qq
DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -qq --no-install-recommends mesa-vulkan-drivers libvulkan1 >/dev/null
echo "setup: done"
