#pragma once
// All parts of the parser together.

#include "frontend/syntax/grammar/block_context.h"
#include "frontend/syntax/grammar/block_parser.h"
#include "frontend/syntax/grammar/data_parser.h"
#include "frontend/syntax/grammar/expression_parser.h"
#include "frontend/syntax/grammar/instruction_parser.h"
#include "frontend/syntax/grammar/lookahead.h"
#include "frontend/syntax/grammar/module_parser.h"
#include "frontend/syntax/grammar/parameter_parser.h"
#include "frontend/syntax/grammar/routine_parser.h"
#include "frontend/syntax/grammar/type_parser.h"
#include "frontend/syntax/recovery/end_words.h"
#include "frontend/syntax/recovery/foreign_forms.h"
#include "frontend/syntax/recovery/later_words_reader.h"
#include "frontend/syntax/recovery/misspelt_words.h"
#include "frontend/syntax/recovery/name_reader.h"
#include "frontend/syntax/recovery/strategy.h"
#include "frontend/syntax/recovery/synchronizer.h"
#include "frontend/syntax/recovery/torn_words.h"
#include "frontend/syntax/recovery/wrong_signs.h"

namespace rapid::syntax {

/// One parser for one file: what its parts share, and the parts.
struct Parser {
    Parser(SyntaxTree& tree, diag::Sink& sink, const ParseOptions& parseOptions)
        : options(parseOptions), in(tree), nodes(tree, in), lexical(in, sink),
          reports(in, sink, lexical, torn) {}

    const ParseOptions& options;
    TokenCursor in;
    TreeBuilder nodes;
    LexicalMistakes lexical;
    Reports reports;
#define PARSER_PART(Type, name) Type name{*this};
#include "frontend/syntax/grammar/parser_parts.def"
};

inline ParserPart::ParserPart(Parser& parser)
    : parser_(parser), in_(parser.in), nodes_(parser.nodes), reports_(parser.reports) {}
#define PARSER_PART(Type, name)                                                                              \
    inline Type& ParserPart::name() const {                                                                  \
        return parser_.name;                                                                                 \
    }
#include "frontend/syntax/grammar/parser_parts.def"

} // namespace rapid::syntax
