#pragma once
int inner(int pin);
