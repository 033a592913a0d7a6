#include "simpletools.h"
int main() { high(26); }
