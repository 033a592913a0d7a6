#include "simpletools.h"
template<typename... T> void all(T... p){ int q[]={p...}; for(int x:q) high(x);}
int main(){while(1){all(8);pause(100);}}
