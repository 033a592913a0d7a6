#include "simpletools.h"
namespace lamp{void on(int p){high(p);}}
int main(){while(1){lamp::on(8);pause(100);}}
