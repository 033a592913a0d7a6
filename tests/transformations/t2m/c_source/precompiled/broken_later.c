#include "board.h"
int between;
#include "broken.h"
int main() { return get_input(LED) + nowhere; }
