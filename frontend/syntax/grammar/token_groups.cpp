#include "frontend/syntax/grammar/token_groups.h"

namespace rapid::syntax {

RoutineWords wordsOf(RoutineKind kind) {
    switch (kind) {
    case RoutineKind::Proc: break;
    case RoutineKind::Func: return {TokenKind::KwFunc, TokenKind::KwEndfunc, "FUNC"};
    case RoutineKind::Trap: return {TokenKind::KwTrap, TokenKind::KwEndtrap, "TRAP"};
    }
    return {TokenKind::KwProc, TokenKind::KwEndproc, "PROC"};
}

bool isBasicType(std::string_view word) {
    static constexpr std::string_view kTypes[] = {
#define BASIC_TYPE(name) name,
#include "frontend/syntax/recovery/spellings.def"
    };
    for (const std::string_view type : kTypes)
        if (equalsNoCase(word, type)) return true;
    return false;
}

} // namespace rapid::syntax
