#include "simpletools.h"

int sum(int a, int b)
{
	return a + b;	// tab inside
}

int main()
{
	int n = 1;
	high(n);
	while (1)
	{
		if (n)
			n = sum(n, 1);
        pause(n);
	}
}
