#include <iostream>

#include "tests/unit/bus/topics_page.hpp"

int main() { std::cout << aisle::bus_test::topics_page(); }
