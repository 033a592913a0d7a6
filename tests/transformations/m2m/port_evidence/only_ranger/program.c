#include "simpletools.h"
#include "ping.h"
int main() { print("%d", ping_cm(8)); high(3); }
