//! What a call answers: a documented status, and an error struct that is written if, and only if, the call failed.

use crate::block::{CANARY, Placed};
use crate::source::Source;
use umbilic::capi::*;

/// The caller's error struct: null, or memory of the size that it claims, all canaries behind that.
pub struct Outcome(Option<Placed<umb_error>>);

const WHOLE: usize = size_of::<umb_error>();

impl Outcome {
    pub fn new(source: &mut Source<'_>) -> Outcome {
        let (claimed, present) = match source.byte() {
            0..160 => (WHOLE, WHOLE),
            160..192 => (0, WHOLE),
            192..208 => {
                let size = WHOLE + 1 + source.below(32);
                (size, size)
            }
            208..224 => {
                let size = 1 + source.below(WHOLE - 1);
                (size, size.max(4))
            }
            _ => return Outcome(None),
        };
        let mut placed = Placed::sized(source, &crate::structs::zeroed(), present);
        placed.bytes_mut().fill(CANARY);
        placed.bytes_mut()[..4].copy_from_slice(&(claimed as u32).to_ne_bytes());
        Outcome(Some(placed))
    }

    pub fn pointer(&self) -> *mut umb_error {
        self.0.as_ref().map_or(std::ptr::null_mut(), Placed::pointer)
    }

    /// Checks the status of a call that may answer with [`UMB_OK`] or one of `allowed`; whether it succeeded.
    pub fn check(&self, call: &str, status: umb_status, allowed: &[umb_status]) -> bool {
        let text = self.message();
        assert!(
            status == UMB_OK || allowed.contains(&status),
            "{call} answers {status}, which is not documented for it: {text:?}"
        );
        let Some(placed) = &self.0 else { return status == UMB_OK };
        let bytes = placed.bytes();
        let claimed = u32::from_ne_bytes(bytes[..4].try_into().expect("four bytes")) as usize;
        let written = if status == UMB_OK || (claimed != 0 && claimed < WHOLE) { 4 } else { WHOLE };
        let untouched = bytes[written.min(bytes.len())..].iter().all(|&byte| byte == CANARY);
        assert!(untouched, "{call} answers {status} and writes to the error struct beyond byte {written}");
        if written == WHOLE {
            let error: umb_error = placed.read();
            assert_eq!(error.status, status, "{call}: the error struct has another status");
            let text = text.unwrap_or_else(|| panic!("{call}: the message of status {status} is no C string"));
            assert!(!text.is_empty(), "{call}: status {status} has no message");
        }
        status == UMB_OK
    }

    /// The message, if there is room for one and it is UTF-8 with a closing NUL.
    fn message(&self) -> Option<String> {
        let bytes = self.0.as_ref()?.bytes().get(16..WHOLE)?;
        let end = bytes.iter().position(|&byte| byte == 0)?;
        Some(std::str::from_utf8(&bytes[..end]).ok()?.to_owned())
    }
}
