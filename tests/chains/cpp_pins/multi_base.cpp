#include "simpletools.h"
struct A{int a;A(int x):a(x){}};struct B{int b;B(int x):b(x){}};
struct C:A,B{C():A(3),B(8){} void on(){high(b);}};
int main(){C c;while(1){c.on();pause(100);}}
