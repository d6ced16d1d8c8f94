#include "stdlib/impl/support/data_names.h"

namespace rt::lib {

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
