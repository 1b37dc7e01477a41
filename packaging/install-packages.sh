#!/usr/bin/env bash
# Installs what is missing of the packages listed in packages.txt.
#   packaging/install-packages.sh [build|test]     test includes build; build is the default
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
want=${1:-build}

missing=()
while read -r group package; do
  [[ $group == build || $group == "$want" ]] || continue
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
done < <(grep -v -e '^#' -e '^$' "$here/packages.txt")

[[ ${#missing[@]} -gt 0 ]] || exit 0
echo "Installing ${#missing[@]} missing Debian packages: ${missing[*]}" >&2
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || { echo "These packages are missing and sudo is not here: ask an administrator to install them: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
