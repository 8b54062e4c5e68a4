//! What `lobe exercise` and `lobe mark` print, ready to become JSON.
