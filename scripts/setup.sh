#!/bin/sh
# Installs the Debian packages that billow needs and that are missing here. With --ci also those of the checks in .ci/run.
set -eu

packages="build-essential cmake ninja-build pkg-config libhdf5-dev libsuitesparse-dev libccd-dev libcmocka-dev
python3 python3-numpy python3-h5py python3-matplotlib"
[ "${1:-}" != --ci ] || packages="$packages git clang clang-format clang-tidy libclang-rt-14-dev"

if ! command -v dpkg-query >/dev/null; then
    echo "setup.sh: this is not Debian or Ubuntu; install what these packages hold, then go on:" $packages >&2
    exit 0
fi

missing=
for package in $packages; do
    # the second letter of the state: i for installed
    case $(dpkg-query -W -f '${db:Status-Abbrev}\n' "$package" 2>/dev/null) in
    *?i*) ;;
    *) missing="$missing $package" ;;
    esac
done
[ -n "$missing" ] || exit 0

echo "Installing:$missing"
as_root=
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "setup.sh: ask an administrator to run: apt-get install$missing" >&2
        exit 1
    fi
    as_root=sudo
fi
$as_root apt-get update -q
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
