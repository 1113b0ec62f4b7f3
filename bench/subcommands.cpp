// A program that measures several subjects: PROGRAM SUBJECT [OPTION...] [MESH...]
#include "program.hpp"

int main(int count, char** words) { return espalier::bench::Subcommand::run_named(count, words); }
