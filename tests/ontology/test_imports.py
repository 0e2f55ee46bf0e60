"""Imports are resolved by catalog, file name or header, never fetched, and reported if missing."""

import pytest

from usd2kg.errors import OntologyError
from usd2kg.ontology import load_home_tbox, load_tbox
from usd2kg.ontology.catalog import find_document

CATALOG = '<catalog prefer="public" xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">{}</catalog>'


@pytest.fixture
def write_catalog(tmp_path):
    """Return a function that writes `catalog-v001.xml` from IRI → file."""

    def write(**places):
        entries = "".join(f'<uri name="{iri}" uri="{place}"/>' for iri, place in places.items())
        (tmp_path / "catalog-v001.xml").write_text(CATALOG.format(entries))

    return write


def ontology(iri, *imports):
    listed = "".join(f" ; owl:imports <{name}>" for name in imports)
    return f"<{iri}> a owl:Ontology{listed} .\n"


def names(tbox):
    return [cls.local_name for cls in tbox.classes]


PHYSICAL = ":Cup rdfs:subClassOf :Crockery . :Plan rdfs:subClassOf :Idea .\n"
UPPER = ":Crockery rdfs:subClassOf dul:PhysicalObject .\n"
"""Imported document that makes :Cup and :Crockery physical, but not :Plan."""


def test_resolves_imports_by_catalog(write_turtle, write_catalog):
    write_catalog(**{"http://example.com/upper": "lib/other_name.ttl"})
    write_turtle(ontology("http://example.com/upper") + UPPER, "lib/other_name.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL))
    assert (names(tbox), tbox.imports, tbox.notes) == (["Crockery", "Cup"], ("http://example.com/upper",), ())


@pytest.mark.parametrize("name", ["upper.ttl", "upper.owl", "upper"])
@pytest.mark.parametrize(
    "iri", ["http://example.com/upper", "http://example.com/upper.owl", "http://example.com/upper#", "urn/upper/"]
)
def test_resolves_imports_by_file_name(write_turtle, name, iri):
    if iri.endswith(".owl") and name == "upper":
        name = "upper.owl"
    write_turtle(UPPER, name)
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", iri) + PHYSICAL))
    assert (names(tbox), tbox.notes) == (["Crockery", "Cup"], ())


def test_reads_transitive_imports(write_turtle):
    write_turtle(ontology("http://example.com/a", "http://example.com/b"), "a.ttl")
    write_turtle(ontology("http://example.com/b") + UPPER, "b.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/a") + PHYSICAL))
    assert names(tbox) == ["Crockery", "Cup"]
    assert tbox.imports == ("http://example.com/a", "http://example.com/b")


def test_accepts_cyclic_imports(write_turtle):
    write_turtle(ontology("http://example.com/a", "http://example.com/home") + UPPER, "a.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/a") + PHYSICAL))
    assert (names(tbox), tbox.imports) == (["Crockery", "Cup"], ("http://example.com/a",))


def test_cycle_by_version_iri_does_not_import_the_file_itself(write_turtle, write_catalog):
    write_catalog(**{"http://example.com/a": "a.ttl", "http://example.com/home/1.0": "home.ttl"})
    write_turtle(ontology("http://example.com/a", "http://example.com/home/1.0") + UPPER, "a.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/a") + PHYSICAL))
    assert (names(tbox), tbox.imports) == (["Crockery", "Cup"], ("http://example.com/a",))


def test_reads_an_import_with_two_iris_once(write_turtle):
    write_turtle(ontology("http://other.org/name") + UPPER, "upper.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL))
    assert (names(tbox), tbox.imports) == (["Crockery", "Cup"], ("http://other.org/name",))


@pytest.mark.parametrize(
    "header",
    [
        "<http://example.com/upper> a owl:Ontology .",
        "<http://example.com/upper#>\n  rdf:type owl:Ontology .",
        '<owl:Ontology rdf:about="http://example.com/upper">',
        "Ontology: <http://example.com/upper>",
        "Ontology(<http://example.com/upper>",
        '<Ontology ontologyIRI="http://example.com/upper">',
    ],
)
def test_finds_an_import_by_the_iri_that_a_file_declares(tmp_path, header):
    (tmp_path / "importing.ttl").write_text("<http://example.com/a> owl:imports <http://example.com/upper> .")
    (tmp_path / "longer.ttl").write_text("<http://example.com/upper2> a owl:Ontology .")
    assert find_document("http://example.com/upper", tmp_path) is None
    (tmp_path / "museum.ttl").write_text(header)
    assert find_document("http://example.com/upper", tmp_path) == tmp_path / "museum.ttl"


def test_reports_a_missing_import(write_turtle):
    path = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL)
    tbox = load_tbox(path)
    assert names(tbox) == ["Crockery", "Cup", "Idea", "Plan"]  # no class is known to be physical
    assert [(note.code, note.message) for note in tbox.notes] == [
        (
            "missing-import",
            f"{path}: imports <http://example.com/upper>, which neither catalog-v001.xml nor a file in the folder names"
            "; the hierarchy is built without it",
        )
    ]


def test_import_with_a_too_long_name_is_missing(write_turtle):
    # File systems limit names to 255 bytes.
    path = write_turtle(ontology("http://example.com/home", "http://example.com/" + "a" * 400) + PHYSICAL)
    assert [note.code for note in load_tbox(path).notes] == ["missing-import"]


def test_reports_the_same_missing_import_once(write_turtle):
    write_turtle(ontology("http://example.com/a", "http://example.com/gone"), "a.ttl")
    home = ontology("http://example.com/home", "http://example.com/a", "http://example.com/gone")
    assert len(load_tbox(write_turtle(home + PHYSICAL)).notes) == 1


def test_decodes_catalog_uris(write_turtle, write_catalog):
    # XML Catalogs 1.1, section 6.1: `uri` is a URI reference, so spaces are percent-encoded.
    write_catalog(**{"http://example.com/upper": "my%20upper.ttl"})
    write_turtle(UPPER, "my upper.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL))
    assert tbox.notes == ()


def test_catalog_entry_without_its_file_is_a_missing_import(write_turtle, write_catalog):
    write_catalog(**{"http://example.com/upper": "gone.ttl"})
    write_turtle(UPPER, "upper.ttl")  # the catalog entry takes precedence over the file name
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL))
    assert [note.code for note in tbox.notes] == ["missing-import"]


def test_reads_catalogs_of_protege(write_turtle, tmp_path):
    group = '<group id="Folder Repository" prefer="public" xml:base=""><uri id="x" name="{}" uri="u.ttl"/></group>'
    (tmp_path / "catalog-v001.xml").write_text(CATALOG.format(group.format("http://example.com/upper")))
    write_turtle(UPPER, "u.ttl")
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL))
    assert names(tbox) == ["Crockery", "Cup"]


@pytest.mark.parametrize("text", ["<catalog", "", "no xml at all"])
def test_rejects_a_malformed_catalog(write_turtle, tmp_path, text):
    (tmp_path / "catalog-v001.xml").write_text(text)
    path = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL)
    with pytest.raises(OntologyError) as caught:
        load_tbox(path)
    message = str(caught.value)
    assert message.startswith(f"{tmp_path / 'catalog-v001.xml'}: the catalog is not well-formed XML (")
    assert message.endswith("; fix or remove it")
    assert "\n" not in message


def test_catalog_is_not_needed_without_imports(write_turtle, tmp_path):
    (tmp_path / "catalog-v001.xml").write_text("<catalog")
    assert names(load_tbox(write_turtle(PHYSICAL))) == ["Crockery", "Cup", "Idea", "Plan"]


def test_rejects_a_malformed_import_with_its_path(write_turtle, tmp_path):
    (tmp_path / "upper.ttl").write_text("@prefix broken")
    path = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL)
    with pytest.raises(OntologyError, match=r"upper\.ttl: looks like Turtle or N-Triples but does not parse"):
        load_tbox(path)


# --- access to other folders ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "iri",
    [
        "http://example.com/../secret.ttl",
        "http://example.com/..",
        "http://example.com/..%2Fsecret.ttl",
        "file:///etc/passwd",
        "../secret.ttl",
    ],
)
def test_import_iris_do_not_reach_other_folders(write_turtle, iri):
    write_turtle(UPPER, "secret.ttl")
    path = write_turtle(ontology("http://example.com/home", iri) + PHYSICAL, "inside/home.ttl")
    tbox = load_tbox(path)
    assert [note.code for note in tbox.notes] == ["missing-import"]
    assert tbox.imports == ()


@pytest.mark.parametrize("place", ["http://example.com/upper.ttl", "file://{outside}"])
def test_catalogs_do_not_reach_network_or_file_urls(write_turtle, write_catalog, tmp_path, place):
    outside = write_turtle(UPPER, "elsewhere/upper.ttl")
    write_catalog(**{"http://example.com/gone": place.format(outside=outside)})
    path = write_turtle(ontology("http://example.com/home", "http://example.com/gone") + PHYSICAL)
    assert [note.code for note in load_tbox(path).notes] == ["missing-import"]


def test_hash_covers_the_whole_closure(write_turtle):
    write_turtle(UPPER, "upper.ttl")
    home = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL)
    first = load_tbox(home).content_hash
    assert load_tbox(home).content_hash == first
    write_turtle(UPPER + ":Extra a owl:Class .", "upper.ttl")
    assert load_tbox(home).content_hash != first


@pytest.mark.parametrize("quoted", ["", "%2F"])
def test_ignores_absolute_catalog_entries(write_turtle, write_catalog, tmp_path, quoted):
    place = str(write_turtle(UPPER, "elsewhere/secret.ttl"))
    write_catalog(**{"http://example.com/upper": quoted + place[1:] if quoted else place})
    tbox = load_tbox(write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL))
    assert [note.code for note in tbox.notes] == ["missing-import"]


def test_catalogs_may_reach_sibling_folders(write_turtle, tmp_path):
    write_turtle(UPPER, "upper/u.ttl")
    home = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL, "home/home.ttl")
    entry = '<uri name="http://example.com/upper" uri="../upper/u.ttl"/>'
    (tmp_path / "home" / "catalog-v001.xml").write_text(CATALOG.format(entry))
    assert names(load_tbox(home)) == ["Crockery", "Cup"]


@pytest.mark.parametrize("text", ["secret words", "@prefix secret words", "<secret words", "{secret"])
def test_errors_do_not_quote_files_outside_the_folder(write_turtle, tmp_path, text):
    (tmp_path / "notes.ttl").write_text(text)
    home = write_turtle(ontology("http://example.com/home", "http://example.com/upper"), "home/home.ttl")
    entry = '<uri name="http://example.com/upper" uri="../notes.ttl"/>'
    (tmp_path / "home" / "catalog-v001.xml").write_text(CATALOG.format(entry))
    with pytest.raises(OntologyError, match=r"notes\.ttl: (not an ontology|looks like Turtle)") as caught:
        load_tbox(home)
    assert "secret" not in str(caught.value)


@pytest.mark.parametrize("is_link", [False, True])
def test_catalogs_open_no_other_files_outside_the_folder(write_turtle, tmp_path, is_link):
    (tmp_path / "notes.txt").write_text(
        "@prefix : <http://x#> . :A <http://www.w3.org/2000/01/rdf-schema#subClassOf> :B ."
    )
    home = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL, "home/home.ttl")
    if is_link:
        (tmp_path / "home" / "upper.ttl").symlink_to(tmp_path / "notes.txt")
    place = "upper.ttl" if is_link else "../notes.txt"
    entry = f'<uri name="http://example.com/upper" uri="{place}"/>'
    (tmp_path / "home" / "catalog-v001.xml").write_text(CATALOG.format(entry))
    assert [note.code for note in load_tbox(home).notes] == ["missing-import"]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-32", "nonsense"])
def test_reads_catalogs_as_utf_8(write_turtle, tmp_path, encoding):
    declared = f'<?xml version="1.0" encoding="{encoding}"?>'
    entry = '<uri name="http://example.com/upper" uri="ü.ttl"/>'
    (tmp_path / "catalog-v001.xml").write_text(declared + CATALOG.format(entry), encoding="utf-8")
    write_turtle(UPPER, "ü.ttl")
    home = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL)
    assert names(load_tbox(home)) == ["Crockery", "Cup"]


def test_rejects_catalogs_in_other_encodings(write_turtle, tmp_path):
    (tmp_path / "catalog-v001.xml").write_text(CATALOG.format(""), encoding="utf-32")
    home = write_turtle(ontology("http://example.com/home", "http://example.com/upper") + PHYSICAL)
    with pytest.raises(OntologyError, match=r"catalog-v001\.xml: byte 0 is not UTF-8 text, expected a catalog"):
        load_tbox(home)


def test_an_import_with_more_classes_is_extended(write_turtle):
    write_turtle(
        ontology("http://example.com/shop") + ":Cup rdfs:subClassOf :Ware . :Pan rdfs:subClassOf :Ware .", "shop.ttl"
    )
    path = write_turtle(ontology("http://example.com/own", "http://example.com/shop") + ":Mug rdfs:subClassOf :Cup .")
    assert names(load_tbox(path)) == ["Cup", "Mug", "Pan", "Ware"]


def test_an_import_with_fewer_classes_is_a_hierarchy_to_place_classes_in(write_turtle):
    write_turtle(ontology("http://example.com/upper") + ":Cup rdfs:subClassOf :Ware .", "upper.ttl")
    text = ":Mug rdfs:subClassOf :Cup . :Beaker rdfs:subClassOf :Mug ."
    path = write_turtle(ontology("http://example.com/own", "http://example.com/upper") + text)
    tbox = load_tbox(path)
    assert names(tbox) == ["Beaker", "Cup", "Mug"]


def test_an_import_that_is_not_used_is_not_extended(write_turtle):
    text = ":Instant rdfs:subClassOf :Time . :Interval rdfs:subClassOf :Time . :Year rdfs:subClassOf :Time ."
    write_turtle(ontology("http://example.com/time") + text, "time.ttl")
    path = write_turtle(ontology("http://example.com/own", "http://example.com/time") + ":Cup rdfs:subClassOf :Ware .")
    assert names(load_tbox(path)) == ["Cup", "Ware"]


def test_built_in_ontologies_stand_in_for_imports(write_turtle):
    home = load_home_tbox()
    tbox = load_tbox(
        write_turtle(ontology("http://example.com/own", home.ontology_iri) + ":Mug rdfs:subClassOf soma:Cup .")
    )
    assert (tbox.notes, tbox.imports) == ((), (home.ontology_iri,))
    assert len(tbox.classes) == len(home.classes) + 1
    (mug,) = (cls for cls in tbox.classes if cls.local_name == "Mug")
    assert mug.parents == (home.resolve("Cup"),)
