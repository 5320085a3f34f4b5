// The program `lkao`.
#include "cli/command_line.h"
#include "cli/interrupt.h"

int main(int argc, char** argv) {
  lkao::cli::install_interrupt_handlers();
  return lkao::cli::answer_command_line(argc, argv);
}
