#include "unguarded.h"
#include "unguarded.h"
#include "board.h"
#include "unguarded.h"
int main() { twice(TWICE); }
