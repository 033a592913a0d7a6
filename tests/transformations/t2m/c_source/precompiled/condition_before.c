#ifdef FAST
#define SPEED 200
#endif
#include "board.h"
int main() { return get_input(SPEED); }
