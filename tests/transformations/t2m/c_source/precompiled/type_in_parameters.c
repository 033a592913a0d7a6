#include "board.h"
static int first(ptr, count)
struct s { int a; };
int *ptr; int count;
{ return get_input(count); }
int main() { return first(0, LED); }
