#include "turn.h"
int main() { turn(45); return 0; }
