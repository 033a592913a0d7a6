#define SPEED 3
#include "board.h"
int main() { return get_input(SPEED); }
