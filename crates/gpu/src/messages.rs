//! Messages of the validation layer, kept for tests and logged for users.

use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;

/// Ids of messages about calls that neither this crate nor its callers make: a driver's own layer looks up
/// functions of the instance through the device (NVIDIA 580). `ash` looks up only functions of a device in
/// that way.
const OF_OTHERS: &[&str] = &["WARNING-vkGetDeviceProcAddr-device"];

/// Warnings and errors of the validation layer, in order. Clones share one list, which outlives the device.
#[derive(Debug, Clone, Default)]
pub struct ValidationLog {
    messages: Arc<Mutex<Vec<String>>>,
}

impl ValidationLog {
    /// Returns all messages so far.
    pub fn messages(&self) -> Vec<String> {
        self.messages.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Returns the description of a messenger for an instance that a host makes, so that this log collects
    /// its messages as well.
    ///
    /// # Safety
    /// The log keeps its address until the messenger and its instance are destroyed.
    pub unsafe fn messenger(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
        messenger_info(self)
    }

    fn push(&self, message: String) {
        self.messages.lock().unwrap_or_else(PoisonError::into_inner).push(message);
    }
}

/// Returns the description of a messenger that writes into `log`, which must keep its address until the
/// instance is destroyed.
pub(crate) fn messenger_info(log: &ValidationLog) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
        )
        // General messages come from the loader (drivers it could not open) and are unrelated to the calls of
        // this crate.
        .message_type(
            vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
        )
        .pfn_user_callback(Some(receive))
        .user_data(std::ptr::from_ref(log).cast_mut().cast())
}

/// Receives each message from Vulkan.
///
/// # Safety
/// `data` is null or valid for the call, and `user` is null or points to a live [`ValidationLog`].
unsafe extern "system" fn receive(
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    if data.is_null() || user.is_null() {
        return vk::FALSE;
    }
    // SAFETY: not null, and Vulkan keeps it valid during the call.
    let data = unsafe { &*data };
    // SAFETY: not null, and `messenger_info` requires the log to outlive the instance.
    let log = unsafe { &*user.cast::<ValidationLog>() };
    let text = |pointer: *const std::ffi::c_char| {
        if pointer.is_null() {
            return String::new();
        }
        // SAFETY: not null, and Vulkan passes NUL-terminated strings that live during the call.
        unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned()
    };
    let id = text(data.p_message_id_name);
    if OF_OTHERS.contains(&id.as_str()) {
        return vk::FALSE;
    }
    let message = format!("{id}: {}", text(data.p_message));
    if severity.contains(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR) {
        tracing::error!(target: "rasray_gpu::validation", "{message}");
    } else {
        tracing::warn!(target: "rasray_gpu::validation", "{message}");
    }
    log.push(message);
    vk::FALSE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_kept_but_for_those_about_calls_of_others() {
        let log = ValidationLog::default();
        let info = messenger_info(&log);
        let callback = info.pfn_user_callback.expect("there is one");
        for id in [c"VUID-vkCmdDispatch-None-08114", c"WARNING-vkGetDeviceProcAddr-device"] {
            let data = vk::DebugUtilsMessengerCallbackDataEXT::default().message_id_name(id).message(c"why");
            let (severity, kind) = (
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
                vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION,
            );
            // SAFETY: data and log live during the call.
            assert_eq!(unsafe { callback(severity, kind, &data, info.p_user_data) }, vk::FALSE);
        }
        assert_eq!(log.messages(), ["VUID-vkCmdDispatch-None-08114: why"]);
    }
}
