#include "board.h"
#undef LED
struct Robot { void stop(); };
int main() { Robot robot(LED); robot.stop(); }
