#pragma once

namespace aisle::process {

/// Large blocks go back to the operating system as soon as they are freed. Before the first large allocation, once a process.
void keep_no_large_blocks();

/// Gives back what was freed and lies unused between what is still in use, e.g. after reading a map. Takes well under a millisecond.
void give_back_free_memory();

}  // namespace aisle::process
