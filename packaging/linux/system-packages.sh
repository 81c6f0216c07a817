#!/usr/bin/env bash
# Install the system libraries that Qt and VTK need, and the tools the tests use; Debian 12 and Ubuntu 24.04.
# Usage: system-packages.sh PYTHON
set -euo pipefail
python=${1:-python3}

if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
    echo "Insole Studio needs Python 3.11 or newer; '$python' is not. Call make with PYTHON=/path/to/python3.11." >&2
    exit 1
fi

packages=(xvfb xauth admesh libegl1 libgl1 libgl1-mesa-dri libglx-mesa0 libxkbcommon-x11-0 libxcb-cursor0
    libxcb-icccm4 libxcb-image0 libxcb-keysyms1 libxcb-randr0 libxcb-render-util0 libxcb-shape0 libxcb-xinerama0
    libxcb-xkb1 libxrender1 libxtst6 libdbus-1-3 libfontconfig1 fonts-dejavu-core)
"$python" -c 'import ensurepip, venv' 2>/dev/null || packages+=(python3-venv)

# Independent witnesses of the tests of the Kinect driver, of the solids and of milling, and the database that stations share; where one
# cannot be had, its tests are skipped by name.
optional=(postgresql libusb-1.0-0 umockdev gir1.2-umockdev-1.0 python3-gi libfreenect-bin libfreenect0.5 prusa-slicer
    linuxcnc-uspace)

is_missing() { ! dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }

missing=() wanted=()
for package in "${packages[@]}"; do is_missing "$package" && missing+=("$package"); done
for package in "${optional[@]}"; do is_missing "$package" && wanted+=("$package"); done
[ $((${#missing[@]} + ${#wanted[@]})) -eq 0 ] && exit 0

# Without the required packages nothing works; without the optional ones it does.
give_up() {
    echo "$1" >&2
    [ ${#missing[@]} -eq 0 ] && exit 0
    exit 1
}
command -v apt-get >/dev/null ||
    give_up "Please install the equivalents of these Debian packages, then run make again: ${missing[*]} ${wanted[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || give_up "Please have root run: apt-get install ${missing[*]} ${wanted[*]}"
    as_root=(sudo)
fi
install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends)
"${as_root[@]}" apt-get update -qq
[ ${#missing[@]} -eq 0 ] || "${install[@]}" "${missing[@]}" >/dev/null
# The tests start a PostgreSQL of their own; the package would start another one, for everybody, at every boot.
clusters=/etc/postgresql-common/createcluster.conf
if [[ " ${wanted[*]} " == *" postgresql "* ]] && "${install[@]}" postgresql-common >/dev/null 2>&1; then
    "${as_root[@]}" sed -i 's/^#\?create_main_cluster *=.*/create_main_cluster = false/' "$clusters"
fi
for package in "${wanted[@]}"; do
    "${install[@]}" "$package" >/dev/null 2>&1 || echo "$package cannot be installed; the tests that use it will be skipped." >&2
done
