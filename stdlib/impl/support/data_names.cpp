#include "stdlib/impl/support/data_names.h"

#include <algorithm>
#include <functional>

namespace rt::lib {
const GlobalDesc* dataAt(const Controller& controller, const void* address) {
    const auto& rows = controller.tables().globals();
    const auto found = std::find_if(rows.begin(), rows.end(), [address](const GlobalDesc* row) {
        const auto* first = static_cast<const char*>(row->address);
        const std::less<const void*> before;
        return !before(address, first) && before(address, first + row->type->size);
    });
    return found == rows.end() ? nullptr : *found;
}

bool isPersistent(const Controller& controller, const void* address) {
    const GlobalDesc* data = dataAt(controller, address);
    return data != nullptr && data->kind == kGlobalPersistent;
}

std::string nameOfData(const Controller& controller, const void* data) {
    for (const GlobalDesc* row : controller.tables().globals())
        if (row->address == data) return std::string(row->module) + ":" + row->name;
    return {};
}

AnyRef dataByName(const Task& task, const std::string& name) {
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) return {};
    const GlobalDesc* row = task.controller().findGlobal(name.substr(colon + 1), name.substr(0, colon), task);
    return row == nullptr ? AnyRef{} : AnyRef{row->address, row->type};
}

} // namespace rt::lib
