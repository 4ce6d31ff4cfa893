//! What the device says to objects that are made: whether there was memory, whether it takes them.
//!
//! Native devices answer at once. Browsers answer later, and nothing here waits for them unless it is asked
//! to: what nobody hears goes to the error scope or the handler that the caller has.

use std::{
    fmt,
    pin::pin,
    task::{Context, Poll, Waker},
};
use wgpu::{Device, ErrorFilter};

/// Why the device did not make something.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// There was no memory.
    Memory,
    /// What the device says is wrong.
    Invalid(String),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Memory => "out of memory",
            Self::Invalid(reason) => reason,
        })
    }
}

/// What `make` makes, and the future in which the device will have said what it thinks of it.
pub(super) fn ask<T, M: FnOnce() -> T>(
    device: &Device,
    make: M,
) -> (T, impl Future<Output = Option<Refusal>> + use<T, M>) {
    // Objects whose memory is missing are invalid, and so are others that are made from them.
    let [others, invalid, memory] =
        [ErrorFilter::Internal, ErrorFilter::Validation, ErrorFilter::OutOfMemory]
            .map(|filter| device.push_error_scope(filter));
    let made = make();
    let [memory, invalid, others] = [memory, invalid, others].map(wgpu::ErrorScopeGuard::pop);
    let answer = async {
        if memory.await.is_some() {
            return Some(Refusal::Memory);
        }
        let error = match invalid.await {
            None => others.await,
            error => error,
        };
        error.map(|error| Refusal::Invalid(error.to_string()))
    };
    (made, answer)
}

/// The same where devices answer at once; elsewhere no answer.
pub(super) fn ask_now<T>(device: &Device, make: impl FnOnce() -> T) -> (T, Option<Refusal>) {
    if device.adapter_info().backend == wgpu::Backend::BrowserWebGpu {
        return (make(), None);
    }
    let (made, answer) = ask(device, make);
    match pin!(answer).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(refusal) => (made, refusal),
        Poll::Pending => (made, None),
    }
}
