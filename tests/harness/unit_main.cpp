// Entry point of the unit tests; the test framework is compiled here once.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
