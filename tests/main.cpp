// The entry point of the tests: Catch2's own.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
