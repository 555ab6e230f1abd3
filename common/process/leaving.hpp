#pragma once

namespace aisle::process {

/// From here on an abort() is one line on stderr and exit code 0. For a process that has done its work, said good-bye
/// and only takes its middleware down: Fast DDS 3.1 as Debian builds it (asserts on) may abort when a peer leaves at
/// the moment in which its lease is looked at (PDP::check_remote_participant_liveliness, `GUID_t::unknown() !=
/// remote_participant->m_guid`).
void take_an_abort_for_the_end();

}  // namespace aisle::process
