#pragma once

namespace aisle::sim {

/// From now on SQLite opens its files on the simulated disk of the process that runs (ScopedDisk), and on the host's
/// outside any scope. May be called again.
void put_sqlite_on_simulated_disks();

}  // namespace aisle::sim
