#include "tools/rapidc/dap/routine_constants.h"

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

namespace rapidc::dap {

namespace sema = rapid::sema;
namespace syntax = rapid::syntax;

namespace {

std::string textOf(const sema::ConstValue& value, const sema::Type* type) {
    switch (value.kind) {
    case sema::ConstValue::Kind::Bool: return value.boolean ? "TRUE" : "FALSE";
    case sema::ConstValue::Kind::String: {
        std::string text = "\"";
        for (const char c : value.text())
            text += c == '"' ? std::string("\"\"") : std::string(1, c);
        return text + "\"";
    }
    case sema::ConstValue::Kind::Aggregate: {
        std::string text = "[";
        std::size_t index = 0;
        for (const sema::ConstValue& member : value.members()) {
            const bool record = type != nullptr && index < type->base()->components.size();
            text +=
                (index > 0 ? "," : "") + textOf(member, record ? type->base()->components[index].type : type);
            ++index;
        }
        return text + "]";
    }
    default: break;
    }
    const bool isDnum = type != nullptr && type->base()->kind == sema::TypeKind::Dnum;
    return isDnum ? rt::formatDnum(value.number) : rt::formatNum(static_cast<float>(value.number));
}

} // namespace

std::vector<ConstantText> constantsOf(const Compilation& compilation, std::size_t task,
                                      const rt::RoutineDesc& routine) {
    std::vector<ConstantText> list;
    if (task >= compilation.program->tasks.size()) return list;
    for (const sema::Module* module : compilation.program->tasks[task]->modules) {
        if (!rt::sameName(module->name, routine.module)) continue;
        for (const sema::RoutineSymbol* symbol : module->routines) {
            if (!rt::sameName(symbol->name, routine.name)) continue;
            for (const sema::DataSymbol* data : symbol->data) {
                if (data->storage != sema::Storage::RoutineData || data->decl == nullptr ||
                    data->dataKind != syntax::DataKind::Const || data->type.type == nullptr)
                    continue;
                // Arrays: the members of the outer dimensions are aggregates as well.
                const sema::Type* type = data->type.rank > 0 && data->type.type->components.empty()
                                             ? data->type.type
                                         : data->type.rank > 0 ? nullptr
                                                               : data->type.type;
                list.push_back({data->name, data->type.type->name, textOf(data->value(), type)});
            }
        }
    }
    return list;
}

} // namespace rapidc::dap
