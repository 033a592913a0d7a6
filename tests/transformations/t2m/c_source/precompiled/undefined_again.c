#include "board.h"
#undef LED
int main() { set_output(LED, 1); return get_input(LED); }
