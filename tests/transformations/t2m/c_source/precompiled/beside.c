#include "beside.h"
#include "board.h"
int own_function(int pin) { return get_input(pin); }
int main() { return own_function(BESIDE); }
