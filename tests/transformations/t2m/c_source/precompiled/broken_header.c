#include "broken.h"
#include "board.h"
int main() { return get_input(LED); }
