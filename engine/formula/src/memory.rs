//! Chunks of values, each on cache lines of its own.

use crate::machine::Machine;
use std::alloc::{Layout, alloc_zeroed, dealloc, handle_alloc_error};
use std::ptr::NonNull;

/// Bytes of a cache line, and of the longest vector.
const LINE: usize = 64;

/// Memory that is reached by pointers alone: several parts of it are in use at once.
#[derive(Debug)]
pub(crate) struct Memory<R> {
    first: NonNull<R>,
    layout: Layout,
}

impl<R: Machine> Memory<R> {
    /// Room for so many chunks, at least one, all of it zero.
    pub fn new(chunks: usize) -> Self {
        let bytes = chunks.max(1) * R::CHUNK * size_of::<R>();
        // A program has some thousands of operations at most: that is far from an overflow.
        let layout = Layout::from_size_align(bytes, LINE).unwrap_or(Layout::new::<[u64; 8]>());
        // SAFETY: the layout has a size.
        let first = NonNull::new(unsafe { alloc_zeroed(layout) });
        let first = first.unwrap_or_else(|| handle_alloc_error(layout));
        Memory {
            first: first.cast(),
            layout,
        }
    }

    /// The first value of a chunk.
    pub fn chunk(&self, index: usize) -> *mut R {
        let first = index * R::CHUNK;
        assert!((first + R::CHUNK) * size_of::<R>() <= self.layout.size());
        // SAFETY: it is in what was allocated.
        unsafe { self.first.as_ptr().add(first) }
    }
}

impl<R> Drop for Memory<R> {
    fn drop(&mut self) {
        // SAFETY: it was allocated with this layout.
        unsafe { dealloc(self.first.as_ptr().cast(), self.layout) };
    }
}
