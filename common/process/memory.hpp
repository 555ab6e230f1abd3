#pragma once

namespace aisle::process {

/// Large blocks go back to the operating system as soon as they are freed. Before the first large allocation, once a
/// process.
void keep_no_large_blocks();

/// Gives back what was freed and lies unused between what is still in use, e.g. after reading a map. Takes well under a
/// millisecond.
void give_back_free_memory();

/// Unmaps the program's and its libraries' code and constants; what is still used comes back from the page cache at its
/// next use. What only a start needs (symbol tables, parsers, discovery) stops counting as resident: about half of a
/// Fast DDS process. Nothing under a debugger.
void give_back_unused_code();

}  // namespace aisle::process
