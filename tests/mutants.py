"""Wrong functions, made of a right one: a term left out, a sign or an operator turned, one off."""

import ast

TURNED = {
    ast.Add: [ast.Sub],
    ast.Sub: [ast.Add],
    ast.Mult: [ast.Div],
    ast.Div: [ast.Mult],
    ast.FloorDiv: [ast.Div],
    ast.BitAnd: [ast.BitOr],
    ast.Lt: [ast.LtE, ast.Gt],
    ast.LtE: [ast.Lt, ast.GtE],
    ast.Gt: [ast.GtE, ast.Lt],
    ast.GtE: [ast.Gt, ast.LtE],
    ast.Eq: [ast.NotEq],
}
SYMMETRIC = {"np.maximum", "np.minimum"}  # their arguments can be exchanged


def mutants(source):
    """The functions that differ from `source` in one place: {source: what its changed line is}."""
    tree, found = ast.parse(source), {}
    whole = ast.unparse(tree)
    for parent in list(ast.walk(tree)):
        for name, value in ast.iter_fields(parent):
            for place, part in enumerate(value if isinstance(value, list) else [value]):
                for other in _changes(part):
                    _put(parent, name, place, other)
                    text = ast.unparse(tree)
                    new = set(text.splitlines()) - set(whole.splitlines())
                    found[text] = " ".join(line.strip() for line in new)
                _put(parent, name, place, part)
    found.pop(whole, None)
    return found


def define(source, names):
    """The function that `source` defines among `names`; each of its `while` ends after 99 turns."""
    tree = ast.fix_missing_locations(_Ending().visit(ast.parse(source)))
    names = dict(names)
    exec(compile(tree, "mutant", "exec"), names)  # noqa: S102
    return names[tree.body[0].name]


def _put(parent, name, place, part):
    if isinstance(value := getattr(parent, name), list):
        value[place] = part
    else:
        setattr(parent, name, part)


def _changes(part):
    """What can stand in the place of a part of a tree, and is nearly the same."""
    match part:
        case ast.BinOp(left, op, right):
            yield from (left, right)
            yield from (ast.BinOp(left, turned(), right) for turned in TURNED.get(type(op), ()))
        case ast.AugAssign(target, op, value):
            yield ast.Pass()
            yield from (ast.AugAssign(target, turned(), value) for turned in TURNED[type(op)])
        case ast.UnaryOp(_, operand):
            yield operand
        case ast.Constant(int() | float() as value) if not isinstance(value, bool):
            yield ast.Constant(value + 1)
        case ast.Compare(left, [op], right):
            yield from (ast.Compare(left, [turned()], right) for turned in TURNED[type(op)])
        case ast.Call(function, given, named):
            yield from _calls(function, given, named)
        case ast.Subscript(value, _, ast.Load()) | ast.Attribute(value, "T"):
            yield value
        case ast.Tuple([one, other], ast.Load()) | ast.List([one, other], ast.Load()):
            yield type(part)([other, one], ast.Load())
        case ast.Return(ast.BinOp() | ast.Call() as value):
            yield ast.Return(ast.UnaryOp(ast.USub(), value))
        case ast.If():
            yield ast.Pass()


def _calls(function, given, named):
    """A call with two arguments exchanged, or without one; what it is made of, without the call."""
    if len(given) > 1 and ast.unparse(function) not in SYMMETRIC:
        yield ast.Call(function, [given[1], given[0], *given[2:]], named)
    for one in named:
        if one.arg != "strict":
            yield ast.Call(function, given, [other for other in named if other != one])
    yield from (one for one in given[:1] if not isinstance(one, ast.Starred))
    if isinstance(function, ast.Attribute) and ast.unparse(function.value) != "np":
        yield function.value


class _Ending(ast.NodeTransformer):
    def visit_While(self, node):
        self.generic_visit(node)
        end = ast.If(ast.UnaryOp(ast.Not(), node.test), [ast.Break()], [])
        turns = ast.Call(ast.Name("range", ast.Load()), [ast.Constant(99)], [])
        return ast.For(ast.Name("_", ast.Store()), turns, [end, *node.body], [])
