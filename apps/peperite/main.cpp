// peperite: runs, checks, resumes, describes and compares.
#include "sph/run/command_line.hpp"

int main(int argc, char** argv) { return sph::tool_main(argc, argv); }
