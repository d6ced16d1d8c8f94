#pragma once
// A mark for natives.

/// A native that programs inline, however long it is. GCC makes none of their bodies, and refuses the attribute without `inline`.
#if defined(__clang__)
#define RAPIDC_INLINED [[gnu::always_inline]]
#else
#define RAPIDC_INLINED
#endif
