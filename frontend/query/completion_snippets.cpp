#include "frontend/query/completion_snippets.h"

#include <fmt/format.h>

namespace rapid::query {

using namespace sema;

namespace {

constexpr Construct kStatements[] = {
    {"IF", "IF ... THEN ... ENDIF", "IF ", "IF ${1:condition} THEN\n\t$0\nENDIF"},
    {"IF ELSE", "IF ... THEN ... ELSE ... ENDIF", "IF ", "IF ${1:condition} THEN\n\t$2\nELSE\n\t$0\nENDIF"},
    {"ELSEIF", "ELSEIF ... THEN", "ELSEIF ", "ELSEIF ${1:condition} THEN\n\t$0"},
    {"ELSE", "ELSE", "ELSE", ""},
    {"FOR", "FOR ... ENDFOR", "FOR ", "FOR ${1:i} FROM ${2:1} TO ${3:10} DO\n\t$0\nENDFOR"},
    {"WHILE", "WHILE ... ENDWHILE", "WHILE ", "WHILE ${1:condition} DO\n\t$0\nENDWHILE"},
    {"TEST", "TEST ... ENDTEST", "TEST ", "TEST ${1:value}\nCASE ${2:1}:\n\t$3\nDEFAULT:\n\t$0\nENDTEST"},
    {"CASE", "CASE value:", "CASE ", "CASE ${1:value}:\n\t$0"},
    {"DEFAULT", "DEFAULT:", "DEFAULT:", "DEFAULT:\n\t$0"},
    {"RETURN", "RETURN", "RETURN", ""},
    {"RAISE", "RAISE error;", "RAISE ", "RAISE${1: ERR_NUMBER};$0"},
    {"RETRY", "RETRY;", "RETRY;", ""},
    {"TRYNEXT", "TRYNEXT;", "TRYNEXT;", ""},
    {"EXIT", "EXIT;", "EXIT;", ""},
    {"GOTO", "GOTO label;", "GOTO ", "GOTO ${1:label};$0"},
    {"CONNECT", "CONNECT interrupt WITH trap;", "CONNECT ", "CONNECT ${1:interrupt} WITH ${2:trap};$0"},
    {"VAR", "VAR type name;", "VAR ", "VAR ${1:num} ${2:name};$0"},
    {"PERS", "PERS type name;", "PERS ", "PERS ${1:num} ${2:name}:=${3:0};$0"},
    {"CONST", "CONST type name:=value;", "CONST ", "CONST ${1:num} ${2:name}:=${3:0};$0"},
    {"ENDIF", "ENDIF", "ENDIF", ""},
    {"ENDFOR", "ENDFOR", "ENDFOR", ""},
    {"ENDWHILE", "ENDWHILE", "ENDWHILE", ""},
    {"ENDTEST", "ENDTEST", "ENDTEST", ""},
};

constexpr Construct kDeclarations[] = {
    {"PROC", "PROC ... ENDPROC", "PROC ", "PROC ${1:name}(${2})\n\t$0\nENDPROC"},
    {"FUNC", "FUNC ... ENDFUNC", "FUNC ", "FUNC ${1:num} ${2:name}(${3})\n\tRETURN ${0:0};\nENDFUNC"},
    {"TRAP", "TRAP ... ENDTRAP", "TRAP ", "TRAP ${1:name}\n\t$0\nENDTRAP"},
    {"VAR", "VAR type name;", "VAR ", "VAR ${1:num} ${2:name};$0"},
    {"PERS", "PERS type name:=value;", "PERS ", "PERS ${1:num} ${2:name}:=${3:0};$0"},
    {"CONST", "CONST type name:=value;", "CONST ", "CONST ${1:num} ${2:name}:=${3:0};$0"},
    {"RECORD", "RECORD ... ENDRECORD", "RECORD ",
     "RECORD ${1:name}\n\t${2:num} ${3:component};$0\nENDRECORD"},
    {"ALIAS", "ALIAS type name;", "ALIAS ", "ALIAS ${1:num} ${2:name};$0"},
    {"LOCAL", "LOCAL", "LOCAL ", ""},
    {"TASK", "TASK PERS, TASK VAR", "TASK ", ""},
    {"ENDPROC", "ENDPROC", "ENDPROC", ""},
    {"ENDFUNC", "ENDFUNC", "ENDFUNC", ""},
    {"ENDTRAP", "ENDTRAP", "ENDTRAP", ""},
    {"ENDMODULE", "ENDMODULE", "ENDMODULE", ""},
};

constexpr Construct kFile[] = {
    {"MODULE", "MODULE ... ENDMODULE", "MODULE ",
     "MODULE ${1:name}\n\tPROC ${2:main}()\n\t\t$0\n\tENDPROC\nENDMODULE"},
};

constexpr Construct kHandlers[] = {
    {"ERROR", "error handler", "ERROR", "ERROR\n\tIF ERRNO=${1:ERR_NUMBER} THEN\n\t\t$0\n\tENDIF"},
    {"UNDO", "handler executed when the routine is left", "UNDO", "UNDO\n\t$0"},
    {"BACKWARD", "backward execution of the procedure", "BACKWARD", "BACKWARD\n\t$0"},
    {"ENDPROC", "ENDPROC", "ENDPROC", ""},
    {"ENDFUNC", "ENDFUNC", "ENDFUNC", ""},
    {"ENDTRAP", "ENDTRAP", "ENDTRAP", ""},
};

} // namespace

std::span<const Construct> statementConstructs() {
    return kStatements;
}
std::span<const Construct> declarationConstructs() {
    return kDeclarations;
}
std::span<const Construct> fileConstructs() {
    return kFile;
}
std::span<const Construct> handlerConstructs() {
    return kHandlers;
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '$' || c == '}' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string requiredArguments(const RoutineSymbol& routine) {
    std::string text;
    int number = 0;
    const DataSymbol* before = nullptr;
    for (const DataSymbol* param : routine.params) {
        if (param->optional) continue;
        const bool other = before && param->requiredAlternative && before->group == param->group;
        before = param;
        if (other) continue; // one of several: the first
        text += fmt::format("{}${{{}:{}}}", number ? "," : "", number + 1, escaped(param->name));
        ++number;
    }
    return text;
}

} // namespace rapid::query
