#pragma once
// Values of persistents into module files: for `rapidc run` (as the runtime's ModuleStore) and `rapidc set-value`.

#include "runtime/host/module_store.h"

namespace rapidc {

/// Reads the file, changes what differs, replaces the destination in one step.
class SourceStore final : public rt::ModuleStore {
  public:
    rt::StoreResult store(const rt::ModuleText& text) override;
};

} // namespace rapidc
