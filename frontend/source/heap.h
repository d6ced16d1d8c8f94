#pragma once
// Settings of the system's memory allocator for a process that works on very much text.

namespace rapid {

/// What malloc takes from the system from now on comes in huge pages where the system has them, as that of arenas does:
/// a page fault costs more than filling the page. Only address space is taken at once, no memory.
void putHeapOnHugePages();

} // namespace rapid
