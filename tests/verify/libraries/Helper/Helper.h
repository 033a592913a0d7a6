#pragma once
int help(int pin);
