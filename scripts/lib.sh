# Shared by the scripts beside it; sourced, not run.

say() { printf '\n== %s\n' "$*"; }

# install_packages KIND...: installs what scripts/packages lists for these kinds and the system lacks. With everything
# there already it needs neither the network nor root.
install_packages() {
  local list missing=() package kinds as_root=()
  list="$(dirname "${BASH_SOURCE[0]}")/packages"
  kinds="$(IFS='|'; echo "$*")"
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "This is no Debian or Ubuntu: make sure that the equivalents of these are installed:"
    sed -nE "s/^($kinds) /  /p" "$list"
    return
  fi
  for package in $(sed -nE "s/^($kinds) //p" "$list"); do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2> /dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
      echo "Not root and no sudo here. Please have installed: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  say "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends "${missing[@]}"
}
