// dartboard-harness VERB: every verb.

#include "benchmarks/cli/program.h"
#include "benchmarks/cli/verbs/verbs.h"

int main(int argc, char** argv) { return dartboard::run_program(argc, argv, dartboard::add_all_verbs); }
