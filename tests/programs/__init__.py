"""Programs made by chance, as text: forms that a naive evaluator and the compiler both understand."""
