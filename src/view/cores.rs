//! How many cores a call may keep busy, found without allocating: the standard library's own answer does, and ends the
//! process if there is no memory.

/// The cores that the calling thread may run on, and no more than the limits of its control groups allow; at least 1.
#[cfg(target_os = "linux")]
pub(crate) fn core_count() -> usize {
    linux::allowed().min(linux::quota()).max(1)
}

/// The cores that the process may run on; at least 1.
#[cfg(not(target_os = "linux"))]
pub(crate) fn core_count() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get())
}

#[cfg(target_os = "linux")]
mod linux {
    use std::fs::File;
    use std::io::Read;
    use std::sync::OnceLock;

    /// Of the thread's affinity.
    pub fn allowed() -> usize {
        // SAFETY: a set of bits may be zero, and the call fills as many bytes as it is told.
        unsafe {
            let mut set: libc::cpu_set_t = std::mem::zeroed();
            if libc::sched_getaffinity(0, size_of_val(&set), &raw mut set) == 0 {
                return libc::CPU_COUNT(&set) as usize;
            }
            // More cores than a set has bits.
            libc::sysconf(libc::_SC_NPROCESSORS_ONLN).max(1) as usize
        }
    }

    /// Of the control groups, looked up once in the life of a process: containers limit processor time without hiding cores.
    pub fn quota() -> usize {
        static QUOTA: OnceLock<usize> = OnceLock::new();
        *QUOTA.get_or_init(|| {
            let mut buffer = [0; 4096];
            let groups = read("/proc/self/cgroup", &mut buffer).unwrap_or("");
            groups.lines().map(quota_of).min().unwrap_or(usize::MAX)
        })
    }

    /// Of a line of `/proc/self/cgroup`: `0::/path` in version 2, `4:cpu,cpuacct:/path` in version 1.
    fn quota_of(line: &str) -> usize {
        let mut fields = line.splitn(3, ':');
        let (Some(number), Some(controllers), Some(path)) = (fields.next(), fields.next(), fields.next()) else {
            return usize::MAX;
        };
        let second = number == "0" && controllers.is_empty();
        if !second && !controllers.split(',').any(|controller| controller == "cpu") {
            return usize::MAX;
        }
        let mut least = usize::MAX;
        // A group is held to the limits of those that it is in, too.
        let mut path = Some(path);
        while let Some(group) = path {
            let group = group.trim_end_matches('/');
            let limit = if second {
                cores_in("/sys/fs/cgroup", group, &["cpu.max"])
            } else {
                cores_in("/sys/fs/cgroup/cpu", group, &["cpu.cfs_quota_us", "cpu.cfs_period_us"])
            };
            least = least.min(limit.unwrap_or(usize::MAX));
            path = group.rfind('/').map(|end| &group[..end]);
        }
        least
    }

    /// Quota over period, which stand in one file or in two.
    fn cores_in(root: &str, group: &str, files: &[&str]) -> Option<usize> {
        let mut numbers = [0u64; 2];
        let mut count = 0;
        for file in files {
            // The standard library opens a longer name by way of the heap.
            let (mut name, mut text) = ([0; 383], [0; 64]);
            let name = joined(&mut name, &[root, group, "/", file])?;
            for word in read(name, &mut text)?.split_ascii_whitespace() {
                // "max" and -1 are no numbers, and no limits.
                *numbers.get_mut(count)? = word.parse().ok()?;
                count += 1;
            }
        }
        let [quota, period] = numbers;
        (count == 2 && period > 0).then(|| (quota / period).max(1) as usize)
    }

    /// The parts one after the other, if there is room for them.
    fn joined<'a>(buffer: &'a mut [u8], parts: &[&str]) -> Option<&'a str> {
        let mut length = 0;
        for part in parts {
            buffer.get_mut(length..length + part.len())?.copy_from_slice(part.as_bytes());
            length += part.len();
        }
        std::str::from_utf8(&buffer[..length]).ok()
    }

    /// What a file holds, as far as the buffer goes.
    fn read<'a>(path: &str, buffer: &'a mut [u8]) -> Option<&'a str> {
        let length = File::open(path).ok()?.read(buffer).ok()?;
        std::str::from_utf8(&buffer[..length]).ok()
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn at_least_one() {
            assert!(allowed() >= 1 && super::super::core_count() >= 1);
        }

        #[test]
        fn quotas_of_both_versions() {
            let root = tempfile::tempdir().unwrap();
            let group = root.path().join("outer/inner");
            std::fs::create_dir_all(&group).unwrap();
            std::fs::write(group.join("cpu.max"), "350000 100000\n").unwrap();
            std::fs::write(root.path().join("outer/cpu.max"), "max 100000\n").unwrap();
            std::fs::write(group.join("cpu.cfs_quota_us"), "-1\n").unwrap();
            std::fs::write(group.join("cpu.cfs_period_us"), "100000\n").unwrap();
            let root = root.path().to_str().unwrap();
            assert_eq!(cores_in(root, "/outer/inner", &["cpu.max"]), Some(3));
            assert_eq!(cores_in(root, "/outer", &["cpu.max"]), None);
            let files = ["cpu.cfs_quota_us", "cpu.cfs_period_us"];
            assert_eq!(cores_in(root, "/outer/inner", &files), None);
            std::fs::write(group.join("cpu.cfs_quota_us"), "50000\n").unwrap();
            assert_eq!(cores_in(root, "/outer/inner", &files), Some(1));
            assert_eq!(cores_in(root, &"/long".repeat(200), &["cpu.max"]), None);
        }

        #[test]
        fn lines_that_say_nothing() {
            for line in ["", "0", "0:", "7:memory:/", "3:cpuset:/x", "0::/no such group"] {
                assert_eq!(quota_of(line), usize::MAX, "{line}");
            }
        }
    }
}
