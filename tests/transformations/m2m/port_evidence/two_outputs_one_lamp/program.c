#include "simpletools.h"
int main() { high(3); high(26); }
