#include "tools/rws/negotiation.h"
#include "tools/rws/request_values.h"

#include <catch2/catch.hpp>

using namespace rapidc::rws;

TEST_CASE("exponents whose plus sign a form has lost", "[rws]") {
    CHECK(withExponents("[9E 09,1.E 3,2e 1]") == "[9E+09,1.E+3,2e+1]");
    CHECK(withExponents("[\"1E 5\",1E 5]") == "[\"1E 5\",1E+5]");
    CHECK(withExponents("E 5") == "E 5"); // no number
    CHECK(withExponents("1E x") == "1E x");
    CHECK(withExponents("") == "");
    const auto numbers = numbersIn("[9E 09,-2]", 2);
    REQUIRE(numbers);
    CHECK(*numbers == std::vector<double>{9e9, -2});
}

TEST_CASE("forms that clients of RWS 2.0 accept (serve-contract 18)", "[rws]") {
    CHECK(acceptedForm("application/hal+json;v=2.0", "/rw/panel") == Form::Json);
    CHECK(acceptedForm("application/hal+json;v=2.1", "/rw/elog/0") ==
          Form::TypedXhtml); // lifo, answered as XHTML
    CHECK_FALSE(acceptedForm("application/hal+json;v=2.1", "/rw/panel"));
    CHECK_FALSE(acceptedForm("*/*", "/rw/panel"));
    CHECK(acceptsAnything(" */* "));
    CHECK_FALSE(acceptsAnything("text/html, */*"));
}
