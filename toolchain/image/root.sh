# shellcheck shell=bash
# The unit's root file system. Uses $image_folder and $work of whoever sources it.
# shellcheck disable=SC2154

# shellcheck disable=SC2034  # disk.sh uses them too
# Random for every image, so that two media in one board are not taken for each other.
name_filesystems() {
  root_uuid=$(new_uuid)
  state_uuid=$(new_uuid)
  boot_serial=$(new_uuid | cut -c 1-8 | tr a-f A-F)
}

new_uuid() { cat /proc/sys/kernel/random/uuid; }

# make_root DEB ROOT
make_root() {
  local root=$2
  cp -a "$work/base" "$root"
  cp -a "$work/kernel/usr/lib/modules" "$root/usr/lib/"
  dpkg-deb --fsys-tarfile "$1" | tar -x -C "$root" --keep-directory-symlink --no-same-owner
  cp -r --no-preserve=ownership "$image_folder/root/." "$root/"
  write_accounts "$root"
  write_settings "$root"
  choose_services "$root"
  drop_privileges "$root"
}

# What the scripts of base-files, base-passwd, dash and systemd would have done.
write_accounts() {
  local root=$1
  cp "$root/usr/share/base-passwd/passwd.master" "$root/etc/passwd"
  cp "$root/usr/share/base-passwd/group.master" "$root/etc/group"
  (umask 077 && sed 's/^\([^:]*\):.*/\1:!*:19000:0:99999:7:::/' "$root/etc/passwd" >"$root/etc/shadow")
  systemd-sysusers --root="$root"
}

write_settings() {
  local root=$1
  ln -sf dash "$root/usr/bin/sh"
  ln -sf ../proc/self/mounts "$root/etc/mtab"
  ln -sfn /boot/dottrack "$root/etc/dottrack"
  echo dottrack >"$root/etc/hostname"
  echo "127.0.0.1 localhost dottrack" >"$root/etc/hosts"
  : >"$root/etc/machine-id"
  : >"$root/etc/resolv.conf"
  rm -rf "$root"/var/run "$root"/var/lock
  ln -s /run "$root/var/run"
  ln -s /run/lock "$root/var/lock"
  mkdir -p "$root"/{boot,proc,sys,dev,run,tmp,root,srv}
  : >"$root/etc/fstab" # the initrd has mounted what there is
}

# Only what the preset names is enabled; of what systemd starts by itself, this has no use here.
choose_services() {
  local root=$1 unit
  rm -rf "$root"/etc/systemd/system/*.wants
  systemctl --root="$root" preset-all
  install -D -m 644 -t "$root/etc/systemd/system" "$root/usr/share/systemd/tmp.mount"
  mkdir -p "$root/etc/systemd/system/local-fs.target.wants"
  ln -sf ../tmp.mount "$root/etc/systemd/system/local-fs.target.wants/"
  ln -sf /lib/systemd/system/multi-user.target "$root/etc/systemd/system/default.target"
  while read -r unit; do
    ln -sf /dev/null "$root/etc/systemd/system/$unit"
  done < <(lines_of "$image_folder/masked_units.txt")
  mkdir -p "$root/etc/systemd/system-generators"
  for unit in systemd-getty-generator systemd-gpt-auto-generator; do
    ln -sf /dev/null "$root/etc/systemd/system-generators/$unit"
  done
}

# Nobody logs in, so no program may give more rights than its caller has.
drop_privileges() { find "$1" -xdev -type f -perm /6000 -exec chmod ug-s {} +; }
