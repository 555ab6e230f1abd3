#pragma once

namespace aisle::process {

/// From now on large blocks go back to the operating system as soon as they are freed. Call it once a
/// process, before the first large allocation.
void keep_no_large_blocks();

/// Gives back what was freed and lies unused between what is still in use, e.g. after reading a map. Takes well under a
/// millisecond.
void give_back_free_memory();

/// Unmaps the code and constants of the program and its libraries; what is still used comes back from
/// the page cache at its next use. So code that only the start needs (symbol tables, parsers,
/// discovery) no longer counts as resident: about half of a Fast DDS process. Does nothing under a
/// debugger.
void give_back_unused_code();

}  // namespace aisle::process
