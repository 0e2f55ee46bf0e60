// Checks the consistency of a graph with its ontology by ELK, and finds the contradictory individuals.
//
// Usage: AskElk ONTOLOGY GRAPH        both in Turtle without imports; GRAPH includes ONTOLOGY
//
// Prints one line per result, with tab-separated fields:
//   beyond      NUMBER     axioms of GRAPH beyond OWL 2 EL, which ELK ignores
//   axioms      NUMBER     logical axioms of GRAPH
//   impossible  CLASS      an unsatisfiable class of ONTOLOGY
//   verdict     consistent | inconsistent
//   clash       INDIVIDUAL                    its assertions are contradictory
//   type        INDIVIDUAL  CLASS             an assertion of a minimal contradictory set
//   relation    INDIVIDUAL  PROPERTY  OTHER   an assertion of a minimal contradictory set
//   follows     INDIVIDUAL                    contradictory only through its relations to contradictory individuals

import java.io.File;
import java.util.ArrayList;
import java.util.Collections;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.semanticweb.elk.owlapi.ElkReasonerFactory;
import org.semanticweb.owlapi.apibinding.OWLManager;
import org.semanticweb.owlapi.formats.TurtleDocumentFormat;
import org.semanticweb.owlapi.io.FileDocumentSource;
import org.semanticweb.owlapi.model.AxiomType;
import org.semanticweb.owlapi.model.IRI;
import org.semanticweb.owlapi.model.OWLAxiom;
import org.semanticweb.owlapi.model.OWLClass;
import org.semanticweb.owlapi.model.OWLClassAssertionAxiom;
import org.semanticweb.owlapi.model.OWLClassExpression;
import org.semanticweb.owlapi.model.OWLDataFactory;
import org.semanticweb.owlapi.model.OWLIndividual;
import org.semanticweb.owlapi.model.OWLObjectPropertyAssertionAxiom;
import org.semanticweb.owlapi.model.OWLOntology;
import org.semanticweb.owlapi.profiles.OWL2ELProfile;
import org.semanticweb.owlapi.reasoner.OWLReasoner;

public class AskElk {
    /** An assertion of the graph about an individual: its class, or its relation to another individual. */
    private record Assertion(OWLIndividual subject, OWLClassExpression type, OWLObjectPropertyAssertionAxiom relation) {
        void printFields() {
            if (relation == null) {
                print("type", name(subject), type.isAnonymous() ? type.toString() : name(type.asOWLClass()));
            } else {
                print("relation", name(subject), relation.getProperty().getNamedProperty().getIRI(), name(relation.getObject()));
            }
        }
    }

    private static final OWLDataFactory FACTORY = OWLManager.getOWLDataFactory();

    private static void print(Object... fields) {
        Stream<String> clean = Stream.of(fields).map(field -> String.valueOf(field).replaceAll("\\s+", " "));
        System.out.println(clean.collect(Collectors.joining("\t")));
    }

    private static Object name(OWLIndividual individual) {
        return individual.isNamed() ? individual.asOWLNamedIndividual().getIRI() : individual;
    }

    private static Object name(OWLClass cls) {
        return cls.getIRI();
    }

    public static void main(String[] arguments) throws Exception {
        OWLOntology ontology = load(arguments[0]);
        OWLOntology graph = load(arguments[1]);
        print("axioms", graph.getLogicalAxiomCount());
        print("beyond", new OWL2ELProfile().checkOntology(graph).getViolations().stream()
            .map(violation -> violation.getAxiom()).filter(axiom -> axiom != null && axiom.isLogicalAxiom()).distinct().count());
        for (OWLClass cls : unsatisfiable(ontology)) {
            print("impossible", cls.getIRI());
        }
        OWLReasoner reasoner = new ElkReasonerFactory().createReasoner(graph);
        boolean isConsistent = reasoner.isConsistent();
        reasoner.dispose();
        print("verdict", isConsistent ? "consistent" : "inconsistent");
        if (!isConsistent) {
            explain(graph);
        }
        System.exit(0);
    }

    private static OWLOntology load(String path) throws Exception {
        FileDocumentSource source = new FileDocumentSource(new File(path), new TurtleDocumentFormat());
        return OWLManager.createOWLOntologyManager().loadOntologyFromOntologyDocument(source);
    }

    private static List<OWLClass> unsatisfiable(OWLOntology ontology) {
        OWLReasoner reasoner = new ElkReasonerFactory().createReasoner(ontology);
        List<OWLClass> found = new ArrayList<>();
        if (reasoner.isConsistent()) {
            reasoner.getUnsatisfiableClasses().getEntitiesMinusBottom().stream().sorted().forEach(found::add);
        }
        reasoner.dispose();
        return found;
    }

    // An inconsistent graph entails everything. Therefore each individual becomes a class below its assertions: the
    // unsatisfiable classes are the contradictory individuals, and the others are unaffected.
    private static void explain(OWLOntology graph) throws Exception {
        Map<OWLIndividual, List<Assertion>> assertionsOf = assertions(graph);
        Map<OWLIndividual, OWLClass> classes = new LinkedHashMap<>();
        for (OWLIndividual individual : assertionsOf.keySet()) {
            classes.put(individual, FACTORY.getOWLClass(IRI.create("urn:usd2kg:individual:" + classes.size())));
        }
        Set<OWLAxiom> axioms = graph.logicalAxioms().filter(axiom -> !isAssertion(axiom)).collect(Collectors.toSet());
        assertionsOf.forEach((individual, assertions) -> assertions.forEach(assertion -> axioms.add(
            FACTORY.getOWLSubClassOfAxiom(classes.get(individual), expression(assertion, classes, Set.of())))));
        OWLReasoner reasoner = new ElkReasonerFactory().createReasoner(OWLManager.createOWLOntologyManager().createOntology(axioms));
        Set<OWLClass> bottom = reasoner.getUnsatisfiableClasses().entities().collect(Collectors.toSet());
        Set<OWLIndividual> contradictory = new HashSet<>();
        classes.forEach((individual, cls) -> {
            if (bottom.contains(cls)) {
                contradictory.add(individual);
            }
        });
        contradictory.stream().sorted().forEach(individual -> explain(individual, assertionsOf.get(individual), classes, contradictory, reasoner));
    }

    private static void explain(OWLIndividual individual, List<Assertion> assertions, Map<OWLIndividual, OWLClass> classes,
            Set<OWLIndividual> contradictory, OWLReasoner reasoner) {
        if (reasoner.isSatisfiable(conjunction(assertions, classes, contradictory))) {
            print("follows", name(individual));
            return;
        }
        List<Assertion> needed = new ArrayList<>(assertions);
        List<Assertion> candidates = new ArrayList<>(assertions);
        Collections.reverse(candidates);
        // Remove relations first: two disjoint classes explain more than a class and one of many relations.
        for (Assertion assertion : candidates) {
            List<Assertion> fewer = new ArrayList<>(needed);
            fewer.remove(assertion);
            if (!fewer.isEmpty() && !reasoner.isSatisfiable(conjunction(fewer, classes, contradictory))) {
                needed = fewer;
            }
        }
        print("clash", name(individual));
        needed.forEach(Assertion::printFields);
    }

    private static OWLClassExpression conjunction(List<Assertion> assertions, Map<OWLIndividual, OWLClass> classes, Set<OWLIndividual> contradictory) {
        return FACTORY.getOWLObjectIntersectionOf(assertions.stream().map(assertion -> expression(assertion, classes, contradictory)));
    }

    /** Returns an assertion as a class expression; ignores the assertions of the individuals in `ignored`. */
    private static OWLClassExpression expression(Assertion assertion, Map<OWLIndividual, OWLClass> classes, Set<OWLIndividual> ignored) {
        if (assertion.relation() == null) {
            return assertion.type();
        }
        OWLIndividual other = assertion.relation().getObject();
        OWLClassExpression filler = ignored.contains(other) || !classes.containsKey(other) ? FACTORY.getOWLThing() : classes.get(other);
        return FACTORY.getOWLObjectSomeValuesFrom(assertion.relation().getProperty(), filler);
    }

    private static Map<OWLIndividual, List<Assertion>> assertions(OWLOntology graph) {
        Map<OWLIndividual, List<Assertion>> found = new LinkedHashMap<>();
        graph.axioms(AxiomType.CLASS_ASSERTION).sorted().forEach((OWLClassAssertionAxiom axiom) -> found
            .computeIfAbsent(axiom.getIndividual(), key -> new ArrayList<>())
            .add(new Assertion(axiom.getIndividual(), axiom.getClassExpression(), null)));
        graph.axioms(AxiomType.OBJECT_PROPERTY_ASSERTION).sorted().forEach((OWLObjectPropertyAssertionAxiom axiom) -> found
            .computeIfAbsent(axiom.getSubject(), key -> new ArrayList<>())
            .add(new Assertion(axiom.getSubject(), null, axiom)));
        return found;
    }

    private static boolean isAssertion(OWLAxiom axiom) {
        return AxiomType.ABoxAxiomTypes.contains(axiom.getAxiomType());
    }
}
