#include "simpletools.h"
namespace a{namespace b{void on(int p){high(p);}}}
using namespace a::b;
int main(){on(8);while(1)pause(100);}
