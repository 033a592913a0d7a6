#include "simpletools.h"
constexpr int LED=8;
int main(){high(LED);while(1)pause(100);}
