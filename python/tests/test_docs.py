"""Every public thing is documented, and every example is true: those of the module and those of the README."""

import doctest
import importlib.util
import inspect

import adsdv
import pytest

PUBLIC = {name: getattr(adsdv, name) for name in adsdv.__all__}


def documented():
    """Every public function, class, method and property, by its name."""
    yield "adsdv", adsdv
    for name, thing in PUBLIC.items():
        if callable(thing):
            yield name, thing
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            for member, value in vars(thing).items():
                if not member.startswith("_"):
                    yield f"{name}.{member}", value


THINGS = dict(documented())


@pytest.mark.parametrize("name", THINGS)
def test_it_is_documented(name):
    text = inspect.getdoc(THINGS[name])
    assert text and "." in text
    inherited = [base.__doc__ for base in getattr(THINGS[name], "__mro__", [])[1:]]
    assert text not in inherited


@pytest.mark.parametrize("name", THINGS)
def test_its_examples_are_true(name):
    text = inspect.getdoc(THINGS[name])
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    failures = []
    doctest.DocTestRunner(verbose=False).run(test, out=failures.append)
    assert not failures, "".join(failures)


def test_every_class_and_function_has_an_example():
    with_example = [name for name, thing in THINGS.items() if ">>>" in inspect.getdoc(thing)]
    functions_and_classes = [name for name in THINGS if "." not in name and not name.endswith("Error")]
    assert set(functions_and_classes) <= set(with_example)


def without(text, module):
    """A README but for what needs a module."""
    return "\n## ".join(block for block in text.split("\n## ") if module not in block)


def test_the_examples_of_the_readme_are_true(root, monkeypatch):
    monkeypatch.chdir(root)
    text = (root / "python/README.md").read_text(encoding="utf-8")
    try:
        import pandas
    except ImportError:
        text = without(text, "pandas")
    else:
        pandas.set_option("display.width", 200, "display.max_columns", 20)
    if importlib.util.find_spec("numpy") is None:
        text = without(text, "numpy")
    text = text.replace("```\n", "\n")  # An empty line ends what is expected.
    test = doctest.DocTestParser().get_doctest(text, {}, "README.md", "README.md", 0)
    assert len(test.examples) > 10
    failures = []
    doctest.DocTestRunner(verbose=False, optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=failures.append)
    assert not failures, "".join(failures)
