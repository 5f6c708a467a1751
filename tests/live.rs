//! Programs on a link, under signals and on a disk that is full. They wait for one another: what computes for long is in `scripts.rs`.

mod held;
mod kept;
mod link;
mod linked_prompt;
mod live_page;

#[path = "link/far_end.rs"]
mod far_end;
mod shell;
