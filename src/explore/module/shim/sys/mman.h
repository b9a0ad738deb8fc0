#pragma once
// WASI's own is an error without emulation; without MADV_HUGEPAGE nothing here is asked for.
