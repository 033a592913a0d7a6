#include "board.h" /* never closed
int main() { return get_input(LED); }
