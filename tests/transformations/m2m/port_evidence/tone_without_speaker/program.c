#include "simpletools.h"
int main() { freqout(4, 500, 3000); }
